#pragma once

#include "carving/empty_balls.hpp"

namespace phasetree::carving {

/// Bounds of the support of a solid along a direction d, the maximum of d·p over it.
struct Support {
    double upper = 0;  ///< d·p is nowhere larger on the solid
    double lower = 0;  ///< a point of the solid was found at this d·p; −∞ if none was
    bool is_within_tolerance = true;
};

/// Bounds d·p over the part of the solid within a box, for a unit vector d, with at most this many evaluations. The
/// upper bound is −∞ if the solid is proven empty.
Support support_along(const glm::dvec3& d, EmptyBalls& field, const Bounds& box, double tolerance,
                      std::size_t max_evaluations);

}  // namespace phasetree::carving
