#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// A balanced hierarchy of boxes. Nodes are stored in depth-first order: a node is followed by its first child.
struct BoxTree {
    struct Node {
        Bounds box;
        std::uint32_t second_child = 0;      ///< 0 for a leaf
        std::uint32_t first = 0, count = 0;  ///< a leaf's items: `count` entries of `order` from `first` on
    };
    std::vector<Node> nodes;
    std::vector<std::uint32_t> order;  ///< the indices of the items, leaf by leaf

    /// Divides at the median of the boxes' centres, along the axis along which they extend farthest, until each leaf
    /// has at most `most` items. There must be at least one item. Uses all threads; the result does not depend on their
    /// number.
    BoxTree(std::span<const Bounds> items, std::uint32_t most);

    /// Calls visit(first, count) for each leaf whose box satisfies meets(box).
    template <class Meets, class Visit>
    void for_each_leaf(const Meets& meets, const Visit& visit) const {
        for_each_leaf_from(0, meets, visit);
    }

    /// The same for the leaves from the node `leaf` on, in the order of nodes.
    template <class Meets, class Visit>
    void for_each_leaf_from(std::size_t leaf, const Meets& meets, const Visit& visit) const {
        for (std::size_t i = leaf; i < nodes.size();) {
            const Node& n = nodes[i];
            const bool is_met = meets(n.box);
            if (is_met && n.second_child == 0) visit(n.first, n.count);
            i = is_met || n.second_child == 0 ? i + 1 : behind_[i];
        }
    }

  private:
    std::vector<std::uint32_t> behind_;  // for each node, the first node that is not below it
};

}  // namespace phasetree
