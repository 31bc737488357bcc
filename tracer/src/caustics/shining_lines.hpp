// Straight pieces of lines through media that shine, on which photons start.
#pragma once

#include <optional>

#include "scene/scene.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// A straight piece of a line within one clear phase.
struct ShiningPiece {
    glm::vec3 boundary;  ///< where light that goes in the line's direction leaves the phase
    float length;        ///< from there back to where the piece begins; infinity if it begins nowhere
};

/// The piece that the ray's origin is on; light goes in the ray's direction. The piece begins at the nearest surface or
/// lamp behind the origin, and ends at the first surface ahead. Nothing if a lamp is before that surface, if there is
/// none, or if no photon goes on from it. The phase need not shine.
std::optional<ShiningPiece> shining_piece(const Ray& ray, const World& world, const Scene& scene);

}  // namespace phasetree::tracer
