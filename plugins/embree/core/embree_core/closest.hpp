#pragma once

#include <glm/glm.hpp>

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// The maximum stretch of a linear map: its spectral norm, rounded up.
double largest_stretch(const glm::dmat3&);

struct Closest {
    bool found = false;
    float empty_radius = 0;  ///< no interface is closer than this
    float distance = 0;      ///< of `point`; the search radius if not `found`
    glm::vec3 point{0};      ///< in object space
    Phase here, there;       ///< the phase on the side of the query's point, and the phase beyond
};

/// Finds the closest interface to a point in object space, where distances are measured after a linear map (that of an
/// instance or a placement). Ends when the empty radius differs from the distance by at most the fraction `tolerance`,
/// or by at most four resolutions, or after 2¹⁴ divisions of boxes, each of which may also trace a ray.
Closest find_closest(const CellScene&, const glm::vec3& point, const glm::dmat3& to_world, float radius,
                     float tolerance);

}  // namespace phasetree::embree
