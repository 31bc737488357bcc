// An object may have nothing left, so that its bounds are empty: for instance a filling that has not begun in the first
// frame of a film. Tracing needs bounds that are not empty.
#pragma once

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"

namespace phasetree::tracer {

/// The object, or, if its bounds are empty, another one that is empty and whose bounds are not.
inline Phased with_bounds(const Phased& object) {
    if (!bounds(object).empty()) return object;
    // The ball and the capsule do not touch, but their boxes overlap. So the intersection is empty, and its bounds are
    // not.
    const Field beside = Capsule{.from = {1.8f, 1, -0.1f}, .to = {1.8f, 1, 0.1f}, .radius = 1};
    return phasetree::Set{.phase = Phase{1}, .of = Intersection{.of = {Sphere{.radius = 1}, beside}}};
}

}  // namespace phasetree::tracer
