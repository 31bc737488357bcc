// Measured scattering of milk, marble, skin and other materials, by name: the reduced scattering coefficient σs' = (1 −
// g) σs and the absorption σa in mm⁻¹, for red, green and blue.
//
// Reference: Jensen, Marschner, Levoy & Hanrahan, A Practical Model for Subsurface Light Transport, SIGGRAPH 2001,
// figure 5.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace phasetree::tracer {

struct MeasuredMedium {
    std::string_view name;
    glm::vec3 reduced_scattering;
    glm::vec3 absorption;
};

/// All of them, in alphabetical order.
std::span<const MeasuredMedium> measured_media();

std::optional<MeasuredMedium> find_measured_medium(std::string_view name);

}  // namespace phasetree::tracer
