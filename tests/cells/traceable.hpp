// Objects that can be cut into cells, and the cells at a point.
#pragma once

#include <vector>

#include "phasetree/cells/cells.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "source_directory.hpp"
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

/// The gallery's hourglass.
inline Phased hourglass() {
    return read_tree(Document::from_file(source_directory() + "/scenes/hourglass.json")).object;
}

inline std::vector<std::size_t> cells_at(const InterfaceCells& cells, const glm::vec3& p) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells.bounds(i).contains(p)) found.push_back(i);
    return found;
}

}  // namespace phasetree::tests
