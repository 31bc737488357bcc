// Finds values of parameters for which a point of a surface follows the pointer.
//
// The point p should come to the ray under the pointer. That is two equations, its position across the ray, for as many
// unknowns as numbers may change.
//
// 1. *The point sticks to the surface.* The change Δθ with the least Σ (Δθ / scale)² is found for which the motions of
//    influence.hpp bring the point to the ray; then the point is moved along and back onto the surface, and so on. This
//    is Newton's method for two equations, with a least-norm step. If all motions are parallel across the ray, the step
//    covers the part of the way in their direction.
// 2. *The surface comes to the pointer.* If the point does not come within half a pixel, as when a radius changes and
// the
//    pointer does not move along the normal, f(q; θ) = 0 is solved instead, where q is the point of the ray in the
//    plane through the grabbed point that faces the viewer. This is Newton's method for one equation, again with the
//    least change. If it does not converge either, the result of 1 stays: the point is as near as it comes.
//
// Every step is checked on the object itself, and halved if a node rejects the values or if it leads farther away.
// Numbers stay within their limits. The result is rounded to digits that cannot be seen.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "view/influence.hpp"

namespace phasetree::tracer::view {

/// Where the pointer is.
struct DragTarget {
    glm::dvec3 origin{0}, direction{0};  ///< the ray under the pointer
    glm::dvec3 facing{0};                ///< the direction in which the viewer looked at the grabbed point
    double pixel = 0;                    ///< the width of a pixel at the grabbed point, in the scene's unit
};

struct Dragged {
    NumberEdits values;        ///< of all parameters that may change
    glm::dvec3 position{0};    ///< of the point of the surface
    double miss = 0;           ///< its distance from the ray, in pixels
    bool follows = false;      ///< whether the surface is at the pointer, within half a pixel
    bool sticks = false;       ///< whether the same point of the surface is at the pointer, and not just the surface
    std::size_t readings = 0;  ///< how often the object was read
};

/// Drags a point of a surface. `object` has the numbers that it had when the point was grabbed. Without parameters, the
/// result is the point itself.
Dragged drag(const VariedObject& object, const InterfacePoint& grabbed, std::span<const DragParameter> parameters,
             const DragTarget& target);

}  // namespace phasetree::tracer::view
