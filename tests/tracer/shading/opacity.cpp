// Holes in meshes, and meshes that transmit a part of the light.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "support/statistics.hpp"
#include "tracer/support/paths.hpp"

namespace test_opacity {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string far_away =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [99, 99, 0], "of": {"sphere": {"radius": 1}}}}}})";

Scene scene_with(const std::string& meshes) {
    return scene_of(R"("a": {"diffuse": {"color": [1, 1, 1]}})", far_away,
                    std::string(white_environment) + R"(, "meshes": [)" + meshes + "]");
}

struct Shown {
    explicit Shown(const std::string& meshes) : scene(scene_with(meshes)), world(scene) {}
    Scene scene;
    World world;
};

std::string floor(const std::string& more, const std::string& height = "0") {
    return R"({"floor": {"material": {"diffuse": {"color": [0, 0, 0]}}, "size": 4, "height": )" + height + more + "}}";
}

// Whether a ray from above meets a mesh.
bool is_met(const Shown& shown, const glm::vec3& origin, const glm::vec3& direction = {0, 0, -1}) {
    return surface_met(shown.world, origin, direction).has_value();
}

std::string said(const std::string& meshes) {
    try {
        (void)scene_with(meshes);
    } catch (const phasetree::SceneError& e) {
        return std::string(e.message());
    }
    return {};
}

}  // namespace

TEST_CASE("a hole that a field cuts is where the field says, for rays and for shadows") {
    const Shown cut(floor(R"(, "opacity": {"field": {"of": {"sphere": {"radius": 1}}, "ramp": [[0, 0], [1e-6, 1]]}})"));
    for (int i = 0; i < 200; ++i) {
        const float a = 0.1f * static_cast<float>(i), r = 0.01f * static_cast<float>(i);
        CAPTURE(r);
        const glm::vec3 place(r * std::cos(a), r * std::sin(a), 0);
        if (std::abs(r - 1) < 1e-3f) continue;
        CHECK(is_met(cut, place + glm::vec3(0, 0, 3)) == (r > 1));
        CHECK(is_met(cut, place - glm::vec3(0, 0, 3), {0, 0, 1}) == (r > 1));
        PathCounters counters;
        const Visibility seen =
            cut.world.geometry().visibility(Ray{place + glm::vec3(0, 0, 3), {0, 0, -1}}, 5, counters);
        CHECK(std::holds_alternative<Blocked>(seen) == (r > 1));
    }
}

TEST_CASE("between 0 and 1 rays are stopped with that probability, independently in each layer") {
    const Shown one(floor(R"(, "opacity": 0.3)"));
    const Shown two(floor(R"(, "opacity": 0.3)") + ", " + floor(R"(, "opacity": 0.3)", "0.5"));
    const Shown solid(floor(R"(, "opacity": 0.3, "opacity_cutoff": 0.3)"));
    const Shown none(floor(R"(, "opacity": 0.3, "opacity_cutoff": 0.31)"));
    Moments of_one, of_two;
    constexpr int side = 400;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y) {
            const glm::vec3 origin(3.0f * static_cast<float>(x) / side - 1.5f,
                                   3.0f * static_cast<float>(y) / side - 1.5f, 3);
            of_one.add(is_met(one, origin));
            of_two.add(is_met(two, origin));
            if (x % 40 == 0 && y % 40 == 0) {
                CHECK(is_met(solid, origin));
                CHECK_FALSE(is_met(none, origin));
                CHECK(is_met(one, origin) == is_met(one, origin));
            }
        }
    // The standard error of `of_one` is 0.0011.
    CHECK(mean_p_value(of_one, 0.3) > 1e-4);
    CHECK(mean_p_value(of_two, 0.51) > 1e-4);
    CHECK(mean_p_value(of_one, 0.306) < 1e-4);
    CHECK(mean_p_value(of_two, 0.516) < 1e-4);
}

TEST_CASE("an image's alpha cuts a mesh out") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string image = (folder / "leaf.png").string();
    const auto out = OIIO::ImageOutput::create(image);
    REQUIRE(out);
    REQUIRE(out->open(image, OIIO::ImageSpec(2, 2, 4, OIIO::TypeDesc::UINT8)));
    // Solid at the upper left and the lower right, and black there; the rest is white.
    const unsigned char pixels[] = {0, 0, 0, 255, 255, 255, 255, 0, 255, 255, 255, 0, 0, 0, 0, 255};
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels));
    out->close();
    phasetree::support::write_text(
        folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    const auto leaf = [&](const std::string& channel) {
        return Shown(R"({"obj": {"file": ")" + (folder / "a.obj").string() +
                     R"(", "material": {"diffuse": {"color": [1, 1, 1]}}, "opacity_cutoff": 0.5,
                     "opacity": {"mesh_image": {"file": ")" +
                     image + R"(", "channel": ")" + channel + "\"}}}}");
    };
    const Shown by_alpha = leaf("alpha"), by_blue = leaf("blue");
    for (const float x : {0.25f, 0.75f})
        for (const float y : {0.25f, 0.75f}) {
            CHECK(is_met(by_alpha, {x, y, 3}) == (x != y));
            CHECK(is_met(by_blue, {x, y, 3}) == (x == y));
        }
}

TEST_CASE("what does not fit an opacity is said") {
    CHECK(said(floor(R"(, "opacity_cutoff": 0.5)")).find("\"opacity_cutoff\" requires \"opacity\"") == 0);
    CHECK(said(floor(R"(, "opacity": 1.5)")).find("opacity") != std::string::npos);
    const phasetree::support::TemporaryDirectory folder;
    const std::string image = (folder / "a.png").string();
    const auto out = OIIO::ImageOutput::create(image);
    REQUIRE(out);
    REQUIRE(out->open(image, OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::UINT8)));
    const unsigned char pixel[] = {255, 255, 255};
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixel));
    out->close();
    const auto by_image = [&](const std::string& channel) {
        return floor(R"(, "opacity": {"mesh_image": {"file": ")" + image + R"(", "channel": ")" + channel + "\"}}");
    };
    CHECK(said(by_image("red")).find("\"mesh_image\" needs texture coordinates") == 0);
    CHECK(said(by_image("alpha")).find("it has no alpha channel") != std::string::npos);
}

}  // namespace test_opacity
