#pragma once

/// Draws a random node of a given type, and provides what the tests over all nodes need to know about the type. The
/// drawing itself is compiled once, in random_tree.cpp.

#include "support/random_tree.hpp"
#include "support/random_value.hpp"
#include "tree/node.hpp"

namespace phasetree::tests {

template <class Node>
concept IsFieldNode = requires {
    Node::is_field_node;
};
template <class Node>
concept IsEndlessGrid = requires(Node n) {
    n.boxes.fold;
};
/// Nodes that reject an unbounded child.
template <class Node>
concept NeedsBoundedChild = IsEndlessGrid<Node> || requires(Node n) {
    n.surface;
} || requires(Node n) {
    n.warp;
    requires LocalWarp<decltype(n.warp)>;
};

/// A random value of a node's parameter.
template <class Node, class Value>
void fill(Random& rng, Value& value, const Parameter& p, int depth) {
    // These parameters of Labels must match its content, so they are not random.
    if constexpr (std::is_same_v<Node, Labels>)
        if (p.name == "values" || p.name == "empty" || p.name == "spacing") return;
    detail::fill(rng, value, p, depth, NeedsBoundedChild<Node>);
}

/// One random tree with a node of this kind at its root.
template <class Node>
auto random_rooted(Random& rng, int depth) {
    if constexpr (IsFieldNode<Node>)
        return node_kinds()[index_in<Node>(FieldNodes())].field(rng, depth);
    else
        return node_kinds()[FieldNodes::size + index_in<Node>(PhasedNodes())].object(rng, depth);
}

}  // namespace phasetree::tests
