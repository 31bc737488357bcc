// The variants that hold a node of a tree, and the functions that are derived from a node's list of parameters.
#pragma once

#include <fmt/format.h>

#include "phasetree/nodes/list.hpp"

namespace phasetree {

/// A node of a field's tree, as the handle Field holds it.
struct FieldNode {
    detail::Variant<FieldNodes>::type node;
    std::size_t depth = 1;  ///< of the tree below, this node included
};

/// A node of an object's tree, as the handle Phased holds it.
struct PhasedNode {
    detail::Variant<PhasedNodes>::type node;
    std::size_t depth = 1;
    PhaseSet phases;
};

/// The member of a node that an entry of its parameter list names. Warped nodes overload this, to reach the members of
/// their warp.
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

namespace detail {

std::string describe(const Limits&);

inline void require(bool condition, std::string_view node, const Parameter& p, std::string_view what) {
    if (!condition) throw ModelError(fmt::format("{}: \"{}\" {}", node, p.name, what));
}
inline void check(float v, std::string_view node, const Parameter& p) {
    require(std::isfinite(v), node, p, "must be a finite number");
    if (!p.limits.contains(v)) require(false, node, p, fmt::format("must be {}, but is {}", describe(p.limits), v));
}
inline void check(int v, std::string_view node, const Parameter& p) {
    if (!p.limits.contains(static_cast<float>(v)))
        require(false, node, p, fmt::format("must be {}, but is {}", describe(p.limits), v));
}
inline void check(const glm::vec3& v, std::string_view node, const Parameter& p) {
    for (int i = 0; i < 3; ++i) check(v[i], node, p);
}
inline void check(const glm::vec2& v, std::string_view node, const Parameter& p) {
    for (int i = 0; i < 2; ++i) check(v[i], node, p);
}
inline void check(Phase v, std::string_view node, const Parameter& p) {
    require(v != vacuum && v.index < Phase::capacity, node, p, "must be a phase other than the vacuum");
}
inline void check(const Field& f, std::string_view node, const Parameter& p) {
    require(p.optional || f, node, p, "is missing");
}
inline void check(const Phased& f, std::string_view node, const Parameter& p) {
    require(p.optional || f, node, p, "is missing");
}
template <class Item>
void check(const std::vector<Item>& list, std::string_view node, const Parameter& p) {
    require(p.optional || !list.empty(), node, p, "must not be empty");
    for (const Item& item : list) {
        if constexpr (std::is_same_v<Item, Field> || std::is_same_v<Item, Phased>)
            require(static_cast<bool>(item), node, p, "has an empty entry");
        else
            check(item, node, p);
    }
}
inline void check(PhaseSet set, std::string_view node, const Parameter& p) {
    require(p.optional || !set.empty(), node, p, "must not be empty");
}
template <class Content>
void check(const FromFile<Content>& file, std::string_view node, const Parameter& p) {
    require(file.content != nullptr, node, p, "is missing");
}
template <class Value>
requires(std::is_same_v<Value, float> || std::is_same_v<Value, glm::vec2> || std::is_same_v<Value, glm::vec3> ||
         std::is_same_v<Value, Phase>) void check(const std::vector<Value>& list, std::string_view node,
                                                  const Parameter& p) {
    require(p.optional || !list.empty(), node, p, "must not be empty");
    for (const Value& v : list) check(v, node, p);
}

template <class Node>
std::size_t checked_depth(Node& node) {
    for_each_parameter(node, [&](const auto& value, const Parameter& p) { check(value, Node::info.name, p); });
    prepare(node);
    std::size_t deepest = 0;
    for_each_child(node, [&](const auto& child) { deepest = std::max(deepest, child.node()->depth); });
    if (deepest + 1 > max_tree_depth) throw ModelError(fmt::format("the tree is deeper than {} nodes", max_tree_depth));
    return deepest + 1;
}

template <class Node>
PhaseSet phases_of(const Node& node) {
    if constexpr (requires { node.phases(); })
        return node.phases();
    else
        return phasetree::phases(node.of);  // copies
}

}  // namespace detail

template <class Node>
requires requires {
    Node::is_field_node;
}
Field::Field(Node node) {
    const std::size_t depth = detail::checked_depth(node);
    node_ = std::make_shared<const FieldNode>(FieldNode{std::move(node), depth});
}

template <class Node>
requires requires {
    Node::is_phased_node;
}
Phased::Phased(Node node) {
    const std::size_t depth = detail::checked_depth(node);
    const PhaseSet phases = detail::phases_of(node);
    node_ = std::make_shared<const PhasedNode>(PhasedNode{std::move(node), depth, phases});
}

}  // namespace phasetree
