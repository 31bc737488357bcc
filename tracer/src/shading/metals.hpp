// Measured complex refractive indices η + ik of metals, by name.
//
// Each is the measurement at three wavelengths, 650, 550 and 450 nm for red, green and blue, interpolated linearly
// between the neighbouring points of the published table (as collected by refractiveindex.info, CC0).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace phasetree::tracer {

struct Metal {
    std::string_view name;
    glm::vec3 eta;
    glm::vec3 k;
};

/// All of them, in alphabetical order.
std::span<const Metal> metals();

/// "aluminium" and "aluminum" are both understood.
std::optional<Metal> find_metal(std::string_view name);

}  // namespace phasetree::tracer
