#pragma once

#include "carving/empty_balls.hpp"

namespace phasetree::carving {

/// What is known of the support of a solid along a direction d: the maximum of d·p over it.
struct Support {
    double height = 0;  ///< nothing of the solid has a larger d·p
    double seen = 0;    ///< a point of it was found at this d·p; −∞ if none was
    bool is_within_tolerance = true;
};

/// Bounds d·p over the solid within a box, for a unit vector d, by at most this many evaluations. The height is −∞ if
/// the solid is certainly empty.
Support support_along(const glm::dvec3& d, EmptyBalls& field, const Bounds& box, double tolerance,
                      std::size_t most_evaluations);

}  // namespace phasetree::carving
