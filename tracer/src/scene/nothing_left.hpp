// Objects of which so little is left that not even their bounds have an inside, as of a glass of which a film shows at
// its first frame that nothing is in it yet. What traces rays wants bounds.
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
    // A ball and a capsule that do not touch, though their boxes overlap.
    const Field beside = Capsule{.from = {1.8f, 1, -0.1f}, .to = {1.8f, 1, 0.1f}, .radius = 1};
    return phasetree::Set{.phase = Phase{1}, .of = Intersection{.of = {Sphere{.radius = 1}, beside}}};
}

}  // namespace phasetree::tracer
