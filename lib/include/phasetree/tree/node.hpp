#pragma once

/// What holds a node: a variant over the list, and what is derived from a node's list of parameters.

#include "phasetree/nodes/list.hpp"

namespace phasetree {

struct FieldNode {
    detail::Variant<FieldNodes>::type node;
    std::size_t depth = 1;
};

struct PhasedNode {
    detail::Variant<PhasedNodes>::type node;
    std::size_t depth = 1;
    PhaseSet phases;
};

/// The member that a node's parameter list speaks of. A warped node's list reaches through to its warp.
template <class Node, class T, class Class>
decltype(auto) access(Node& node, T Class::*member) {
    return (node.*member);
}

/// Calls visit(value, parameter) for each parameter of a node.
template <class Node, class Visit>
void for_each_parameter(Node& node, Visit&& visit) {
    std::remove_const_t<Node>::parameters(
        [&](auto member, const Parameter& parameter) { visit(access(node, member), parameter); });
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
