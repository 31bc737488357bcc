// The flat sides by which lamps shine into clear media that bend light: the surface of a lake and the glass of its
// walls, the faces of a cube. Light that comes in by one of them has one direction all over the medium, so that it can
// be looked for wherever one is.
//
// They are found by parallel rays from the brightest lamp over each of the object's six sides: a flat side is met by
// many of them with the same normal, a curved one by few.
#pragma once

#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

class World;
struct Scene;

inline constexpr std::size_t most_flat_boundaries = 3;

// The cosine between normals that count as one: within half a degree.
inline constexpr float one_direction = 0.99996f;

struct FlatBoundary {
    glm::vec3 normal;  // outward, of unit length
    Bounds lit;        // about where rays met it, and as far around as they are apart
};

// Those first that most rays met.
std::vector<FlatBoundary> flat_boundaries(const World& world, const Scene& scene);

}  // namespace phasetree::tracer
