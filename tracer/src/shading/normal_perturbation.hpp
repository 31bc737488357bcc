// What turns the normal by which a surface scatters light, and moves nothing: bumps, or an image of normals.
#pragma once

#include <variant>

#include "shading/bump.hpp"
#include "shading/normal_map.hpp"

namespace phasetree::tracer {

using NormalPerturbation = std::variant<Bump, NormalMap>;

/// The turned normal at a place, of unit length, in the space of textures; place.normal is the surface's own.
inline glm::vec3 perturbed_normal(const NormalPerturbation& perturbation, const TexturePoint& place) {
    return std::visit([&](const auto& kind) { return kind.normal_at(place); }, perturbation);
}

}  // namespace phasetree::tracer
