// Measured complex refractive indices η + ik of metals, by name.
//
// They are published as tables over the wavelength (as collected by refractiveindex.info, CC0), between whose points
// they are interpolated linearly. For red, green and blue they are taken at 650, 550 and 450 nm.
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

/// The index at a wavelength; beyond the table that at its end.
MetalPoint index_at(std::span<const MetalPoint> spectrum, float nanometres);

/// All of them, in alphabetical order.
std::span<const Metal> metals();

/// "aluminium" and "aluminum" are both understood.
std::optional<Metal> find_metal(std::string_view name);

}  // namespace phasetree::tracer
