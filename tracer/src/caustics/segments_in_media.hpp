// Straight segments of lines through emissive media, on which photons start.
#pragma once

#include <optional>

#include "scene/scene.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// A straight segment of a line within one clear phase.
struct MediumSegment {
    glm::vec3 boundary;  ///< where light that travels in the line's direction leaves the phase
    float length;        ///< from there back to the start of the segment; infinity if the segment has no start
};

/// The segment that contains the ray's origin; light travels in the ray's direction. The segment begins at the nearest
/// surface or lamp behind the origin, and ends at the first surface ahead. nullopt if there is no surface ahead, if a
/// lamp is in front of it, or if no photon continues from it. The medium of the phase need not be emissive.
std::optional<MediumSegment> medium_segment(const Ray& ray, const World& world, const Scene& scene);

}  // namespace phasetree::tracer
