#pragma once

#include <glm/glm.hpp>

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// By how much a linear map stretches at most: its spectral norm, rounded up.
double largest_stretch(const glm::dmat3&);

struct Closest {
    bool found = false;
    float empty_radius = 0;  ///< no interface is nearer
    float distance = 0;      ///< of `point`; without `found` the radius that was asked for
    glm::vec3 point{0};      ///< in the object's space
    Phase here, there;       ///< on the side of the query's point, and beyond
};

/// The closest interface to a point of the object's space, where distances are measured behind a linear map (that of an
/// instance or a placement). Ends when the empty radius is within the share `tolerance` of the distance, or within four
/// resolutions, or after 2¹⁴ divisions of boxes, each of which may trace a ray as well.
Closest find_closest(const CellScene&, const glm::vec3& point, const glm::dmat3& to_world, float radius,
                     float tolerance);

}  // namespace phasetree::embree
