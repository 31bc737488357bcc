// Measured complex refractive indices η + ik of metals, by name.
//
// They are published as tables by wavelength (as collected by refractiveindex.info, CC0), interpolated linearly. Those
// for red, green and blue are taken at 650, 550 and 450 nm.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace phasetree::tracer {

struct MetalPoint {
    float nanometres, eta, k;
};

struct Metal {
    std::string_view name;
    glm::vec3 eta, k;                      ///< for red, green and blue
    std::span<const MetalPoint> spectrum;  ///< by wavelength, from 380 nm or less to 780 nm or more
};

/// The index at a wavelength, clamped to the range of the table.
MetalPoint index_at(std::span<const MetalPoint> spectrum, float nanometres);

/// All of them, in alphabetical order.
std::span<const Metal> metals();

/// Accepts both "aluminium" and "aluminum".
std::optional<Metal> find_metal(std::string_view name);

}  // namespace phasetree::tracer
