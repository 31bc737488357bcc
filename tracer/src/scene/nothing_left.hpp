// Empty objects with bounds. An object may be empty, and its bounds too: for example, a filling that has not begun in
// the first frame of an animation. Tracing needs bounds that are not empty.
#pragma once

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"

namespace phasetree::tracer {

/// An empty object whose bounds are about twice this size.
inline Phased nothing_of_size(float size) {
    // The ball and the capsule do not touch, but their boxes overlap. So the intersection is empty, but its bounds are
    // not.
    const Field beside =
        Capsule{.from = size * glm::vec3(1.8f, 1, -0.1f), .to = size * glm::vec3(1.8f, 1, 0.1f), .radius = size};
    return phasetree::Set{.phase = Phase{1}, .of = Intersection{.of = {Sphere{.radius = size}, beside}}};
}

/// Returns the object, or, if its bounds are empty, an empty object with bounds.
inline Phased with_bounds(const Phased& object) {
    return bounds(object).empty() ? nothing_of_size(1) : object;
}

}  // namespace phasetree::tracer
