// Scenes with rough clear phases, for tests of photons that these scatter.
#pragma once

#include <string>

#include "tracer/support/paths.hpp"

namespace phasetree::tracer::tests {

inline std::string in_phase(const std::string& phase, const std::string& shape) {
    return R"({"set": {"phase": ")" + phase + R"(", "of": )" + shape + "}}";
}
inline std::string clear(const std::string& name, double ior, double roughness, const std::string& more = "") {
    return "\"" + name + R"(": {"clear": {"ior": )" + std::to_string(ior) + R"(, "roughness": )" +
           std::to_string(roughness) + more + "}}";
}
// With this number of photons, they and the other techniques all have some weight, which check() requires.
inline std::string lit_by(const std::string& light, double photons = 0.04) {
    return R"("lights": [)" + light + R"(], "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": )" +
           std::to_string(photons) + "}";
}

inline const std::string sun = R"({"sun": {"direction": [0.2, 0.3, 1], "irradiance": [4, 4, 4], "diameter": 60}})";
inline const std::string rectangle =
    R"({"rectangle": {"centre": [1, 1, 4], "target": [0, 0, 0], "width": 3, "height": 3,
                                  "radiance": [5, 5, 5]}})";
inline const glm::vec3 point_position(0.5f, 0.3f, 3);
inline const std::string point = R"({"point": {"position": [0.5, 0.3, 3], "intensity": 20}})";

inline constexpr float ior_of_water = 1.3f, ior_of_oil = 1.1f;

inline Scene pool_of_rough_water(const std::string& light, bool in_oil = false, double roughness = 0.1) {
    const std::string ground =
        in_phase("ground", R"({"translate": {"by": [0, 0, -1], "of": {"box": {"size": [3, 3, 1]}}}})");
    const std::string water = in_phase("water", R"({"box": {"size": [3, 3, 2]}})");
    // Smooth oil surrounds everything, including the lamps.
    const std::string oil = in_phase("oil", R"({"box": {"size": [12, 12, 12]}})");
    return scene_of(clear("water", static_cast<double>(ior_of_water), roughness) +
                        R"(, "ground": {"diffuse": {"color": [0.2, 0.2, 0.2]}})" +
                        (in_oil ? ", " + clear("oil", static_cast<double>(ior_of_oil), 0) : ""),
                    R"({"over": [)" + ground + ", " + water + (in_oil ? ", " + oil : "") + "]}", lit_by(light));
}

}  // namespace phasetree::tracer::tests
