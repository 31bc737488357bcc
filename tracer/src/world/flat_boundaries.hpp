// The flat sides by which lights shine into clear media that bend light: the surface of a lake and the glass of its
// walls, the faces of a cube. Light that comes in by one of them has one direction all over the medium, so a surface
// anywhere inside can look for it there (light_proposal.hpp).
//
// They are found by parallel rays from the brightest light above each of the object's six sides: a flat side is met by
// many of these rays with the same normal, a curved one by few.
#pragma once

#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

class TracedGeometry;
struct Scene;

inline constexpr std::size_t max_flat_boundaries = 3;

/// The least cosine between normals that count as one, which is that of half a degree.
inline constexpr float same_normal_cosine = 0.99996f;

struct FlatBoundary {
    glm::vec3 normal;  ///< outward, of unit length
    Bounds lit;        ///< of the points where rays met it, inflated by the distance between rays
};

/// At most max_flat_boundaries, the one that most rays met first.
std::vector<FlatBoundary> flat_boundaries(const TracedGeometry& geometry, const Scene& scene);

}  // namespace phasetree::tracer
