// A floor below a glass object that surrounds lamps: scenes in which photons are compared with paths alone.
#pragma once

#include <string>

#include "tracer/caustics/photons.hpp"

namespace phasetree::tracer::tests {

// A shell of glass around the middle, and its contents. `inside` has all phases of the tree except the glass.
inline std::string shell_around(const std::string& inside) {
    const std::string shell =
        R"({"set": {"phase": "glass", "of": {"difference": {"from": {"sphere": {"radius": 1}}, "subtract": [{"sphere": {"radius": 0.9}}]}}}})";
    return inside.empty() ? shell : R"({"over": [)" + inside + ", " + shell + "]}";
}
inline constexpr const char* glass = R"("glass": {"clear": {"ior": 1.5}})";
// Photons are gathered within 0.5 or less.
inline const std::string floor_and =
    R"("meshes": [{"floor": {"height": -2.5, "material": {"diffuse": {"color": [0.02, 0.02, 0.02]}}}}],
    "render": {"width": 64, "height": 64, "photons": 12, "photon_radius": 9}, "lights": )";

// Checks that a point of the floor is as bright with photons as with paths alone.
inline void check_floor(const std::string& phases, const std::string& tree, const std::string& lights,
                        int passes_of_photons, double significance = 1e-4) {
    check_against_paths(scene_of(phases, tree, floor_and + lights), {2.4f, 0, -1}, {-1.2f, 0.1f, -1.5f},
                        passes_of_photons, significance);
}

// Checks that a picture of the floor has the same mean with photons as without. `planted_factor` is an error that 128
// samples per pixel detect. The short form takes an eighth of these samples and detects three times that error; the
// long form takes 2048 and detects a quarter of it.
inline void check_picture_of_floor(const std::string& phases, const std::string& tree, const std::string& lights,
                                   double planted_factor) {
    const auto made = [&](bool caustics) {
        return scene_of(
            phases, tree,
            R"("meshes": [{"floor": {"height": -2.5, "material": {"diffuse": {"color": [0.02, 0.02, 0.02]}}}}],
                "camera": {"position": [2.4, 0, -1], "look_at": [1.2, 0.1, -2.5], "fov": 60},
                "render": {"width": 40, "height": 30, "samples": )" +
                std::string(long_form ? "2048" : "16") + R"(, "caustics": )" +
                std::string(caustics ? "true" : "false") + R"(}, "lights": )" + lights);
    };
    check_pictures(made, 1 + (planted_factor - 1) * (long_form ? 0.25 : 3.0), 1e-4);
}

}  // namespace phasetree::tracer::tests
