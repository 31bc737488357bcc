// The flat sides through which lights reach the inside of refractive clear media: the surface of a lake and the glass
// of its walls, the faces of a cube. Light that enters through one of them has the same direction all over the medium,
// so a surface anywhere inside can sample that direction (light_proposal.hpp).
//
// They are found with parallel rays from the brightest light above each of the object's six sides: many of these rays
// meet a flat side with the same normal, but few meet any one normal of a curved side.
#pragma once

#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

class TracedGeometry;
struct Scene;

inline constexpr std::size_t max_flat_boundaries = 3;

/// The minimum cosine between normals that count as equal: that of half a degree.
inline constexpr float same_normal_cosine = 0.99996f;

struct FlatBoundary {
    glm::vec3 normal;  ///< outward, unit length
    Bounds lit;        ///< of the points where rays met it, enlarged by the distance between rays
};

/// At most max_flat_boundaries, in decreasing order of the number of rays.
std::vector<FlatBoundary> flat_boundaries(const TracedGeometry& geometry, const Scene& scene);

}  // namespace phasetree::tracer
