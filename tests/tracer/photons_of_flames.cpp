// Photons of media that shine, against paths alone.
#include <doctest/doctest.h>

#include "shell_scenes.hpp"

namespace test_photons_of_flames {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A phase that shines, with more of its material.
std::string flame_and(const std::string& more) {
    return std::string(glass) + R"(, "flame": {"clear": {"emission": [6, 3, 1], )" + more + "}}";
}

std::string set(const std::string& phase, const std::string& at, double radius) {
    return R"({"set": {"phase": ")" + phase + R"(", "of": {"translate": {"by": )" + at +
           R"(, "of": {"sphere": {"radius": )" + std::to_string(radius) + "}}}}}}";
}

}  // namespace

TEST_CASE("media that shine within glass are as bright with photons as by paths alone") {
    const std::string absorbing = R"("ior": 1, "absorption": [0.5, 1, 2])";
    const std::string flame = set("flame", "[0.2, 0, 0.1]", 0.4), in_glass = set("glass", "[0, 0, 0]", 1);
    SUBCASE("a ball that glass touches") {
        check_picture_of_floor(flame_and(absorbing), R"({"over": [)" + flame + ", " + in_glass + "]}", "[]", 1.01);
    }
    SUBCASE("a ball in a shell, before a wall, with a lamp in it") {
        check_picture_of_floor(
            flame_and(absorbing) + R"(, "wall": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
            shell_around(
                R"({"set": {"phase": "wall", "of": {"translate": {"by": [0.3, 0, 0.1], "of": {"box": {"size": [0.2, 0.7, 0.2]}}}}}}, )" +
                flame),
            R"([{"sphere": {"centre": [-0.1, 0.1, 0.1], "radius": 0.15, "radiance": [0.05, 0, 0]}}])", 1.02);
    }
    SUBCASE("two balls before each other, which scatter, of another index than that around them") {
        check_picture_of_floor(flame_and(R"("ior": 1.3, "scattering": [1, 1, 1], "absorption": [0.5, 1, 2])"),
                               R"({"over": [)" + set("flame", "[0.3, 0, 0.1]", 0.35) + ", " +
                                   set("flame", "[-0.4, 0, -0.1]", 0.35) + ", " + in_glass + "]}",
                               "[]", 1.02);
    }
    SUBCASE("of varying density") {
        check_picture_of_floor(
            flame_and(
                absorbing +
                R"(, "density": {"translate": {"by": [0.2, 0, 0.1], "of": {"sphere": {"radius": 0.35}}}}, "density_depth": 0.1)"),
            R"({"over": [)" + flame + ", " + in_glass + "]}", "[]", 1.02);
    }
}

TEST_CASE("a medium that is lit by a flame is as bright with photons as by paths alone") {
    const auto made = [](bool caustics) {
        return scene_of(
            flame_and(R"("ior": 1, "absorption": [0.5, 1, 2])") +
                R"(, "milk": {"clear": {"ior": 1.4, "scattering": [4, 4, 4], "absorption": [0.1, 0.1, 0.1]}})",
            R"({"over": [)" + set("flame", "[0, 0, 1.6]", 0.4) + ", " + set("milk", "[0, 0, 0]", 1) + "]}",
            R"("camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 15},
                           "render": {"width": 20, "height": 20, "samples": 128, "caustics": )" +
                std::string(caustics ? "true" : "false") + R"(}, "lights": [])");
    };
    check_pictures(made, 1.02, 1e-4);
}

}  // namespace test_photons_of_flames
