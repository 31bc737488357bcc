// Photons of glowing surfaces, compared with paths alone.
#include <doctest/doctest.h>

#include "tracer/support/shell_scenes.hpp"

namespace test_photons_of_glowing {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("what glows within glass is as bright with photons as by paths alone") {
    const std::string phases = std::string(glass) + R"(, "hot": {"glowing": {"radiance": 3}})";
    SUBCASE("a ball that glass touches") {
        check_picture_of_floor(
            phases,
            R"({"over": [{"set": {"phase": "hot", "of": {"translate": {"by": [0.2, 0, 0.1], "of": {"sphere": {"radius": 0.4}}}}}},
                                 {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}]})",
            "[]", 1.01);
    }
    // Forty balls of flame, which hide each other, and a lamp that hides some of them are in the test of flames.
    if (long_form) {
        SUBCASE("beads on a line, which stand before each other, in a shell, and a wall of another phase") {
            check_picture_of_floor(
                phases + R"(, "wall": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
                shell_around(
                    R"({"set": {"phase": "wall", "of": {"translate": {"by": [0, 0.6, 0], "of": {"box": {"size": [0.5, 0.05, 0.5]}}}}}},
                        {"set": {"phase": "hot", "of": {"union": {"of": [
                            {"translate": {"by": [-0.35, 0, 0.1], "of": {"sphere": {"radius": 0.18}}}},
                            {"translate": {"by": [0.05, 0, 0.1], "of": {"sphere": {"radius": 0.18}}}},
                            {"translate": {"by": [0.45, 0.1, 0.2], "of": {"sphere": {"radius": 0.18}}}}]}}}})"),
                "[]", 1.02);
        }
        SUBCASE("within a boundary of clear phases of the same index") {
            check_picture_of_floor(
                phases + R"(, "same": {"clear": {"ior": 1.5}})",
                R"({"over": [{"set": {"phase": "hot", "of": {"translate": {"by": [0.2, 0, 0.1], "of": {"sphere": {"radius": 0.3}}}}}},
                                 {"set": {"phase": "same", "of": {"sphere": {"radius": 0.7}}}},
                                 {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}]})",
                "[]", 1.02);
        }
        SUBCASE("with a lamp beside it that hides a part") {
            check_picture_of_floor(
                phases,
                shell_around(
                    R"({"set": {"phase": "hot", "of": {"translate": {"by": [-0.3, 0, -0.1], "of": {"sphere": {"radius": 0.4}}}}}})"),
                R"([{"sphere": {"centre": [0.4, 0, 0], "radius": 0.2, "radiance": [0.05, 0, 0]}}])", 1.02);
        }
    }
}

TEST_CASE("a mesh that glows under a lens of glass is as bright with photons as by paths alone") {
    const Scene scene = scene_of(
        glass,
        R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}})",
        R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.02, 0.02, 0.02]}}}},
                      {"floor": {"height": 3, "size": 2, "material": {"glowing": {"radiance": 3}}}}],
           "render": {"width": 64, "height": 64, "photons": 12, "photon_radius": 2}, "lights": [])");
    check_against_paths(scene, {-2, -2, 0.1f}, {1.9f, 1.9f, -0.1f}, passes / 4, 1e-4);
}

}  // namespace test_photons_of_glowing
