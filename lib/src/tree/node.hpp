// The variants that hold a node of a tree, and the functions derived from a node's list of parameters.
#pragma once

#include "phasetree/nodes/list.hpp"

namespace phasetree {

/// A node of a field's tree, as held by the handle Field.
struct FieldNode {
    detail::Variant<FieldNodes>::type node;
    std::size_t depth = 1;  ///< of the tree from this node down
};

/// A node of an object's tree, as held by the handle Phased.
struct PhasedNode {
    detail::Variant<PhasedNodes>::type node;
    std::size_t depth = 1;
    PhaseSet phases;
};

/// The member of a node that an entry of its parameter list refers to. Warped nodes overload this to reach the members
/// of their warp.
template <class Node, class T, class Class>
decltype(auto) access(Node& node, T Class::*member) {
    return (node.*member);
}

/// Calls visit(value, parameter) for each parameter of a node. The parameter is a Parameter or derived from it.
template <class Node, class Visit>
void for_each_parameter(Node& node, Visit&& visit) {
    std::remove_const_t<Node>::parameters(
        [&](auto member, const auto& parameter) { visit(access(node, member), parameter); });
}

/// Calls visit(child) for each child, a Field or a Phased, in the order of the parameters.
template <class Node, class Visit>
void for_each_child(const Node& node, Visit&& visit) {
    for_each_parameter(node, [&](const auto& value, const Parameter&) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<T, Field> || std::is_same_v<T, Phased>) {
            if (value) visit(value);
        } else if constexpr (std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, std::vector<Phased>>) {
            for (const auto& child : value) visit(child);
        }
    });
}

}  // namespace phasetree
