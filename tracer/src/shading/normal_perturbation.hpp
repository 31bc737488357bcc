// Perturbation of shading normals without moving geometry: bumps, or a normal map.
#pragma once

#include <variant>

#include "shading/bump.hpp"
#include "shading/normal_map.hpp"

namespace phasetree::tracer {

using NormalPerturbation = std::variant<Bump, NormalMap>;

/// The perturbed normal at a point, of unit length, in texture space; place.normal is the surface's own.
inline glm::vec3 perturbed_normal(const NormalPerturbation& perturbation, const TexturePoint& place) {
    return std::visit([&](const auto& kind) { return kind.normal_at(place); }, perturbation);
}

}  // namespace phasetree::tracer
