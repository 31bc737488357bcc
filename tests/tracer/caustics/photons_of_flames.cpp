// Photons of emitting media, compared with paths alone.
#include <doctest/doctest.h>

#include <numbers>

#include "caustics/points_in_ball.hpp"
#include "phasetree/math/bounds.hpp"
#include "sampling/warps.hpp"
#include "support/uniform.hpp"
#include "tracer/support/shell_scenes.hpp"

namespace test_photons_of_flames {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// Phases: glass, and an emitting flame, with further members of its material.
std::string flame_and(const std::string& more) {
    return std::string(glass) + R"(, "flame": {"clear": {"emission": [6, 3, 1], )" + more + "}}";
}

std::string set(const std::string& phase, const std::string& at, double radius) {
    return R"({"set": {"phase": ")" + phase + R"(", "of": {"translate": {"by": )" + at +
           R"(, "of": {"sphere": {"radius": )" + std::to_string(radius) + "}}}}}}";
}

}  // namespace

TEST_CASE("places of photons are as dense along lines as they say") {
    constexpr float infinity = phasetree::Bounds::infinity;
    const BoundingSphere ball{{1, -2, 3}, 2};
    PointsInBall places(ball);
    phasetree::tests::Uniform random(5);
    std::vector<double> weights(places.bins());
    for (double& weight : weights) weight = static_cast<double>(random()) + 0.01;
    places.set_weights(weights);
    // A line through a random point in a uniformly distributed direction has the density ∫ v / 4π. So the mean of its
    // reciprocal is the measure of all lines that meet the ball, 4π · π r².
    Moments measure;
    for (int i = 0; i < static_cast<int>(samples_of(200000)); ++i) {
        const glm::vec3 direction = square_to_uniform_cone(random.two(), 2.0f);
        const float u_bin = random();
        const glm::vec2 u = random.two();
        const auto place = places.sample(u_bin, {u, random()});
        if (!place) {
            measure.add(0);
            continue;
        }
        REQUIRE(glm::distance(*place, ball.centre) <= ball.radius);
        const glm::vec3 before = *place - 7.0f * direction;
        const double all = static_cast<double>(places.density_along(before, direction, infinity));
        // Two pieces of the line add up to the whole.
        const float cut = 10 * random();
        const double pieces = static_cast<double>(places.density_along(before, direction, cut)) +
                              static_cast<double>(places.density_along(before + cut * direction, direction, infinity));
        REQUIRE(pieces == doctest::Approx(all).epsilon(1e-4));
        // It is the same in the opposite direction.
        REQUIRE(static_cast<double>(places.density_along(before + 14.0f * direction, -direction, infinity)) ==
                doctest::Approx(all).epsilon(1e-4));
        measure.add(4 * std::numbers::pi / all);
    }
    const double expected = 4 * std::numbers::pi * std::numbers::pi * 4;
    CHECK(mean_p_value(measure, expected, 0) > 1e-4);
    CHECK(mean_p_value(measure, detected(1.02) * expected, 0) < 1e-4);
    // Along axes and in coordinate planes, where steps along an axis are infinite. With equal places, the density per
    // length is the same on every line.
    const PointsInBall even(ball);
    const auto per_length = [&](const glm::vec3& direction) {
        return static_cast<double>(even.density_along(ball.centre - 3.0f * direction, direction, infinity)) / 4;
    };
    const double slanting = per_length(glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f)));
    CHECK(slanting > 0);
    for (const glm::vec3& direction :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),
          glm::vec3(0, 0, -1), glm::vec3(0.6f, 0.8f, 0), glm::vec3(0, -0.6f, 0.8f), glm::vec3(-0.8f, 0, -0.6f)}) {
        CAPTURE(direction.x);
        CAPTURE(direction.y);
        CHECK(per_length(direction) == doctest::Approx(slanting).epsilon(1e-4));
    }
    // Half of the line has half of the density, and a line that misses all balls has none.
    CHECK(static_cast<double>(even.density_along(ball.centre - glm::vec3(3, 0, 0), {1, 0, 0}, 3)) / 2 ==
          doctest::Approx(slanting).epsilon(1e-4));
    CHECK(places.density_along({1, 5, 3}, {1, 0, 0}, infinity) == 0.0f);
    CHECK(places.density_along({1, 5, 3}, {0, 1, 0}, infinity) == 0.0f);
    CHECK(places.density_along({1, 5, 3}, {0, -1, 0}, 5.0f) == 0.0f);
}

TEST_CASE("media that shine within glass are as bright with photons as by paths alone") {
    const std::string absorbing = R"("ior": 1, "absorption": [0.5, 1, 2])";
    const std::string flame = set("flame", "[0.2, 0, 0.1]", 0.4), in_glass = set("glass", "[0, 0, 0]", 1);
    SUBCASE("a ball that glass touches") {
        check_picture_of_floor(flame_and(absorbing), R"({"over": [)" + flame + ", " + in_glass + "]}", "[]", 1.01);
    }
    // A medium that scatters is in the next test case.
    if (long_form) {
        SUBCASE("two balls that scatter, one behind the other, whose index is not the glass's") {
            check_picture_of_floor(flame_and(R"("ior": 1.3, "scattering": [1, 1, 1], "absorption": [0.5, 1, 2])"),
                                   R"({"over": [)" + set("flame", "[0.3, 0, 0.1]", 0.35) + ", " +
                                       set("flame", "[-0.4, 0, -0.1]", 0.35) + ", " + in_glass + "]}",
                                   "[]", 1.06);
        }
    }
    SUBCASE("forty balls in a shell, beside what glows, and a lamp that hides some of them from one side") {
        check_picture_of_floor(
            flame_and(absorbing) + R"(, "hot": {"glowing": {"radiance": 0.2}})",
            shell_around(
                R"({"set": {"phase": "flame", "of": {"fibonacci_sphere": {"count": 40, "radius": 0.6, "of": {"sphere": {"radius": 0.08}}}}}}, )" +
                set("hot", "[0, 0, 0]", 0.2)),
            R"([{"rectangle": {"centre": [0.4, 0, 0], "target": [1, 0, 0], "width": 0.5, "height": 0.5, "radiance": [0.05, 0, 0]}}])",
            1.04);
    }
    // The last test case has a flame of varying density, too.
    if (long_form) {
        SUBCASE("of varying density") {
            check_picture_of_floor(
                flame_and(
                    absorbing +
                    R"(, "density": {"translate": {"by": [0.2, 0, 0.1], "of": {"sphere": {"radius": 0.35}}}}, "density_depth": 0.1)"),
                R"({"over": [)" + flame + ", " + in_glass + "]}", "[]", 1.04);
        }
    }
    // The forty balls have a shell and a lamp, too.
    if (long_form) {
        SUBCASE("a ball in a shell, before a wall, with a lamp in it") {
            check_picture_of_floor(
                flame_and(absorbing) + R"(, "wall": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
                shell_around(
                    R"({"set": {"phase": "wall", "of": {"translate": {"by": [0.3, 0, 0.1], "of": {"box": {"size": [0.2, 0.7, 0.2]}}}}}}, )" +
                    flame),
                R"([{"sphere": {"centre": [-0.1, 0.1, 0.1], "radius": 0.15, "radiance": [0.05, 0, 0]}}])", 1.04);
        }
    }
}

TEST_CASE("a medium that is lit by a flame is as bright with photons as by paths alone") {
    // The other test cases are in colours.
    std::string spectral = "true";
    if (long_form) {
        SUBCASE("by wavelength") {}
        SUBCASE("in colours") {
            spectral = "false";
        }
    }
    const auto made = [&](bool caustics) {
        return scene_of(
            flame_and(R"("ior": 1, "absorption": [0.5, 1, 2])") +
                R"(, "milk": {"clear": {"ior": 1.4, "scattering": [4, 4, 4], "absorption": [0.1, 0.1, 0.1]}})",
            R"({"over": [)" + set("flame", "[0, 0, 1.6]", 0.4) + ", " + set("milk", "[0, 0, 0]", 1) + "]}",
            R"("camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 15},
               "render": {"width": 20, "height": 20, "samples": )" +
                std::string(long_form ? "2048" : "10") + R"(, "spectral": )" + spectral + R"(, "caustics": )" +
                std::string(caustics ? "true" : "false") + R"(}, "lights": [])");
    };
    check_pictures(made, long_form ? 1.01 : 1.16, 1e-4);
}

TEST_CASE("flames in objects that are placed, copied and moving are as bright with photons as by paths alone") {
    const auto made = [](bool caustics) {
        return read_scene(phasetree::Document::from_text(
            R"({"version": 1, "phases": {)" +
                flame_and(
                    R"("ior": 1, "absorption": [0.5, 1, 2], "density": {"plane": {"offset": 0.5}}, "density_depth": 1)") +
                R"(, "milk": {"clear": {"ior": 1.4, "scattering": [4, 4, 4], "absorption": [0.1, 0.1, 0.1]}}},
                "objects": [{"name": "ball", "tree": )" +
                set("milk", "[0, 0, 0]", 1) + R"(}, {"name": "fire", "tree": )" + set("flame", "[0, 0, 0]", 0.4) +
                R"(}],
                "instances": [{"of": "ball"},
                    {"of": "fire", "transform": [{"scale": {"factor": 1.3}}, {"rotate": {"axis": [1, 0, 0], "angle": 120}},
                        {"translate": {"by": {"keys": [[0, [-0.5, 0, 1.8]], [1, [0.5, 0, 1.8]]]}}}]},
                    {"of": "fire", "transform": {"translate": {"by": [1.6, 0, 0]}}}],
                "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 15}, "lights": [],
                "render": {"width": 20, "height": 20, "shutter": [0, 1], "samples": )" +
                std::string(long_form ? "4096" : "12") + R"(, "caustics": )" + (caustics ? "true" : "false") + "}}",
            "test.json"));
    };
    check_pictures(made, long_form ? 1.01 : 1.2, 1e-4);
}

}  // namespace test_photons_of_flames
