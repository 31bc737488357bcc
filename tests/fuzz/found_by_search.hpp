// Primitives with long lists of balls or of pieces of a mesh. At a point, a search must find the same as a loop over
// the whole list, to the last bit, and in a box, the few that are selected for it must suffice.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "fuzz/target.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree::fuzz {

inline bool are_same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// `Loop` is the primitive that goes through the whole list; `also(range, p, found)`
/// looks at whatever else the node promises in a box about p, where its distance is `found`.
template <class Loop, class Node, class Also>
void promise_search(const Node& node, Also&& also) {
    const float* data = node.table.data();
    const FlushSubnormals flush;
    for (const float share : {-0.1f, 0.25f, 0.5f}) {
        const glm::vec3 at = node.box.low + share * node.box.extent();
        const Vec3<float> p{at.x, at.y, at.z};
        const float found = Node::distance(data, p);
        promised(are_same(found, Loop::distance(data, p)), "the nearest of the list is found");
        PointRange range;
        for (std::size_t i = 0; i < 3; ++i) {
            range.centre[i] = static_cast<double>(at[static_cast<int>(i)]);
            range.half_extents[i] = 0.01 * static_cast<double>(node.box.diagonal());
        }
        std::vector<float> few;
        if (Node::specialise(data, range, {}, few)) {
            promised(Node::Specialised::is_sound(few), "the few of a box are sound");
            promised(are_same(found, Node::Specialised::distance(few.data(), p)),
                     "the nearest is among the few of a box");
        }
        also(range, p, found);
    }
}

}  // namespace phasetree::fuzz
