// Mixtures of materials, and metals whose reflectance is a texture.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/long_tests.hpp"
#include "tracer/support/paths.hpp"

namespace test_mix {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string ball = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";

struct Shown {
    explicit Shown(const std::string& material) : scene(scene_of("\"a\": " + material, ball)), world(scene) {}
    Surface seen_from(const glm::vec3& origin) const {
        const auto surface = surface_met(world, origin, -origin);
        REQUIRE(surface);
        return *surface;
    }
    Scene scene;
    World world;
};

std::string diffuse(const std::string& color) {
    return R"({"diffuse": {"color": )" + color + "}}";
}
std::string mix(const std::string& first, const std::string& second, const std::string& amount) {
    return R"({"mix": {"first": )" + first + R"(, "second": )" + second + R"(, "amount": )" + amount + "}}";
}

bool is_metal(const Surface& surface) {
    return surface.bsdf().is_delta();
}

glm::vec3 from_around(int i) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / 20000, turn = 2.399963f * static_cast<float>(i);
    const float r = std::sqrt(1 - z * z);
    return 4.0f * glm::vec3(r * std::cos(turn), r * std::sin(turn), z);
}

}  // namespace

TEST_CASE("a mixture is as bright as its two materials by their parts") {
    const Shown shown(mix(diffuse("[1, 0.5, 0]"), diffuse("[0, 0.25, 1]"), "0.3"));
    const glm::dvec3 expected(0.7, 0.7 * 0.5 + 0.3 * 0.25, 0.3);
    // Rays along one line would all meet the same place, which has only one of the two materials. So each ray has its
    // own line.
    std::array<Moments, 3> all;
    for (int i = 0; i < 20000; ++i) {
        const auto one = radiance_along(shown.world, shown.scene, from_around(i), -from_around(i), 1,
                                        static_cast<std::uint32_t>(i) + 1);
        for (std::size_t c = 0; c < 3; ++c) all[c].add(one[c].mean());
    }
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        const double color = expected[static_cast<int>(c)];
        CHECK(mean_p_value(all[c], color) > sidak(1e-4, 3));
        CHECK(mean_p_value(all[c], 1.05 * color) < sidak(1e-4, 3));
    }
}

TEST_CASE("each place has one of a mixture's materials, as a field says, also in a mixture of mixtures") {
    const std::string metal = R"({"conductor": {"metal": "silver"}})", paper = diffuse("[1, 1, 1]");
    const std::string upper = R"({"field": {"of": {"plane": {}}, "ramp": [[-1e-6, 0], [1e-6, 1]]}})";
    const Shown halves(mix(paper, metal, upper));
    const Shown quarters(mix(paper, mix(paper, metal, "0.5"), "0.5"));
    const Shown same(mix(paper, metal, "0.5"));
    Moments of_quarters;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 origin = from_around(i);
        if (std::abs(origin.z) > 0.01f && i % 10 == 0) CHECK(is_metal(halves.seen_from(origin)) == (origin.z > 0));
        of_quarters.add(is_metal(quarters.seen_from(origin)));
        if (i % 100 == 0) CHECK(is_metal(same.seen_from(origin)) == is_metal(same.seen_from(origin)));
    }
    CHECK(mean_p_value(of_quarters, 0.25) > 1e-4);
    CHECK(mean_p_value(of_quarters, 0.27) < 1e-4);
}

TEST_CASE("of a mixture each material has its own normals and its own grain") {
    const std::string bumped =
        R"({"diffuse": {"color": [1, 1, 1], "bump": {"checker": {"size": 0.1}}, "bump_height": 0.1}})";
    const std::string brushed = R"({"conductor": {"metal": "iron", "roughness": 0.3, "grain_along": [0, 0, 1]}})";
    const std::string upper = R"({"field": {"of": {"plane": {}}, "ramp": [[-1e-6, 0], [1e-6, 1]]}})";
    const Shown shown(mix(bumped, brushed, upper));
    int turned = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 origin = from_around(10 * i);
        if (std::abs(origin.z) < 0.01f) continue;
        const Surface surface = shown.seen_from(origin);
        CHECK(surface.along_grain.has_value() == (origin.z > 0));
        const bool is_turned = glm::length(surface.normal - surface.geometric_normal) > 1e-4f;
        if (origin.z > 0) CHECK_FALSE(is_turned);
        turned += is_turned;
    }
    CHECK(turned > 300);
}

TEST_CASE("a metal's reflectance may be a texture") {
    const Shown shown(
        R"({"conductor": {"reflectance": {"checker": {"size": 0.5, "even": [0.9, 0.5, 0.2], "odd": [0.3, 0.3, 0.3]}}}})");
    int of_each[2] = {0, 0};
    for (int i = 0; i < 500; ++i) {
        const Surface surface = shown.seen_from(from_around(40 * i));
        const auto sample = surface.bsdf().sample({0, 0, 1}, 0.5f, {0.5f, 0.5f});
        REQUIRE(sample);
        const bool is_first = sample->weight.x > 0.6f;
        ++of_each[is_first];
        const glm::vec3 color = is_first ? glm::vec3(0.9f, 0.5f, 0.2f) : glm::vec3(0.3f);
        CHECK(glm::length(sample->weight - color) < 1e-5f);
        CHECK(glm::length(1.01f * sample->weight - color) > 1e-3f);
    }
    CHECK(std::min(of_each[0], of_each[1]) > 100);
}

TEST_CASE("photons and paths find the same light on a mixture with a mirror, and on what lets light through") {
    // A ball of glass focuses the sun onto a floor.
    const auto scene_with = [](const std::string& floor, bool caustics) {
        return scene_of(
            R"("a": {"clear": {"ior": 1.5}})",
            R"({"set": {"phase": "a", "of": {"translate": {"by": [0, 0, 1.5], "of": {"sphere": {"radius": 1}}}}}})",
            R"("lights": [{"sun": {"direction": [0, 0, 1], "irradiance": [1, 1, 1], "diameter": 20}}],
                        "meshes": [{"floor": {"size": 6, )" +
                floor + R"(}}], "camera": {"position": [0, -0.01, 0.45], "look_at": [0, 0, 0], "fov": 118},
                        "render": {"width": 32, "height": 32, "samples": )" +
                std::to_string(phasetree::tests::long_tests() ? 160 : 32) + R"(, "caustics": )" +
                (caustics ? "true" : "false") + "}");
    };
    const auto brightness = [&](const std::string& floor, bool caustics) {
        Moments moments;
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            Scene scene = scene_with(floor, caustics);
            scene.settings.seed = seed;
            const World world(scene);
            const Image image = image_of(world, scene);
            double sum = 0;
            for (const glm::vec3& pixel : image.pixels) sum += static_cast<double>(pixel.x);
            moments.add(sum / static_cast<double>(image.pixels.size()));
        }
        return moments;
    };
    const std::string paper = R"({"diffuse": {"color": [0.8, 0.8, 0.8]}})";
    const std::string mirror = R"({"conductor": {"reflectance": [0.01, 0.01, 0.01]}})";
    for (const std::string& floor : {"\"material\": " + paper, "\"opacity\": 0.4, \"material\": " + paper,
                                     "\"material\": " + mix(paper, mirror, "0.5")}) {
        CAPTURE(floor);
        const Moments paths = brightness(floor, false), photons = brightness(floor, true);
        CAPTURE(photons.mean() / paths.mean());
        const double error = std::hypot(paths.standard_error(), photons.standard_error());
        CAPTURE(error / paths.mean());
        const auto p_value = [&](double factor) {
            return phasetree::tests::normal_two_sided((factor * photons.mean() - paths.mean()) / error);
        };
        CHECK(p_value(1) > sidak(1e-4, 3));
        CHECK(p_value(phasetree::tests::long_tests() ? 1.1 : 1.23) < sidak(1e-4, 3));
    }
}

TEST_CASE("what cannot be mixed, and a reflectance beside an index, is rejected") {
    const auto said = [](const std::string& material) {
        try {
            Shown shown(material);
        } catch (const phasetree::SceneError& e) {
            return std::string(e.message());
        }
        return std::string();
    };
    const std::string paper = diffuse("[1, 1, 1]");
    CHECK(said(mix(paper, R"({"glowing": {}})", "0.5")).find("a mix cannot contain a material that emits light") == 0);
    CHECK(said(mix(R"({"clear": {"ior": 1.5}})", paper, "0.5")).find("meshes and mixes cannot be clear") == 0);
    CHECK(said(mix(paper, paper, "1.5")).find("amount") != std::string::npos);
    CHECK(said(R"({"conductor": {"metal": "gold", "reflectance": [1, 1, 1]}})").find("cannot be combined") !=
          std::string::npos);
    CHECK(said(R"({"conductor": {"eta": [1, 1, 1], "reflectance": [1, 1, 1]}})").find("cannot be combined") !=
          std::string::npos);
    CHECK(said(R"({"conductor": {"reflectance": [1, 1, 1], "film_thickness": 300}})").find("cannot have a film") !=
          std::string::npos);
    CHECK(said(R"({"conductor": {}})").find("or \"reflectance\"") != std::string::npos);
}

}  // namespace test_mix
