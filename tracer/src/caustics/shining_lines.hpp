// Straight pieces of lines through media that shine, on which photons start.
#pragma once

#include <optional>

#include "scene/scene.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// A straight piece of a line within one clear phase.
struct ShiningPiece {
    glm::vec3 boundary;  ///< where light that goes in the line's direction leaves the phase
    float length;        ///< from there back to where the piece begins; infinity if nothing ends it
};

/// The piece that a ray's origin is on, with the ray's direction as that of the light. It begins at the surface, or at
/// the lamp, that who looks back from the boundary would see. Nothing if the light meets a lamp before it leaves the
/// phase, or no surface at all.
std::optional<ShiningPiece> shining_piece(const Ray& ray, const World& world, const Scene& scene);

}  // namespace phasetree::tracer
