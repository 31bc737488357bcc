// Random objects that can be cut into cells.
#pragma once

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

inline Phased cut_to_size(Phased object) {
    return IntersectShape{.of = std::move(object), .shape = Box{.size = glm::vec3(3)}, .phases_cut = {}};
}

/// A bounded random object whose bounds are not empty.
inline Phased traceable_object(Random& rng, int depth) {
    for (;;) {
        Phased object = cut_to_size(random_object(rng, depth));
        const Bounds b = bounds(object);
        if (!b.empty() && b.finite()) return object;
    }
}

}  // namespace phasetree::tests
