#pragma once

#include <glm/glm.hpp>

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// The largest factor by which a linear map increases lengths: its spectral norm, rounded up.
double largest_stretch(const glm::dmat3&);

struct Closest {
    bool found = false;
    float empty_radius = 0;  ///< no interface is closer
    float distance = 0;      ///< to `point`; if nothing was found, the requested radius
    glm::vec3 point{0};      ///< in the object's space
    Phase here, there;       ///< on the side of the query point, and on the other side
};

/// Find the closest interface to a point in the object's space. Distances are measured in world space: `to_world` is
/// the linear part of the transform of an instance or a placement.
///
/// Stops when the empty radius is within the fraction `tolerance` of the distance or within four resolutions of it, or
/// after 2¹⁴ subdivisions of boxes, each of which may also trace a ray.
Closest find_closest(const CellScene&, const glm::vec3& point, const glm::dmat3& to_world, float radius,
                     float tolerance);

}  // namespace phasetree::embree
