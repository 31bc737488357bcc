// Turns nodes of all types in the list into handles: checks their parameters and prepares derived data.
#include <fmt/format.h>
#include <stdexcept>
#include <typeindex>
#include <unordered_map>

#include "tree/node.hpp"

namespace phasetree {

namespace {

void require(bool condition, std::string_view node, const Parameter& p, std::string_view what) {
    if (!condition) throw ModelError(fmt::format("{}: \"{}\" {}", node, p.name, what));
}
void check(float v, std::string_view node, const Parameter& p) {
    require(std::isfinite(v), node, p, "must be a finite number");
    if (!p.limits.contains(v))
        require(false, node, p, fmt::format("must be {}, but is {}", detail::describe(p.limits), v));
}
void check(int v, std::string_view node, const Parameter& p) {
    if (!p.limits.contains(static_cast<float>(v)))
        require(false, node, p, fmt::format("must be {}, but is {}", detail::describe(p.limits), v));
}
void check(const glm::vec3& v, std::string_view node, const Parameter& p) {
    for (int i = 0; i < 3; ++i) check(v[i], node, p);
}
void check(const glm::vec2& v, std::string_view node, const Parameter& p) {
    for (int i = 0; i < 2; ++i) check(v[i], node, p);
}
// Each node checks its own texts.
void check(const std::string&, std::string_view, const Parameter&) {}
void check(Phase v, std::string_view node, const Parameter& p) {
    require(v != vacuum && v.index < Phase::capacity, node, p, "must be a phase other than the vacuum");
}
void check(const Field& f, std::string_view node, const Parameter& p) {
    require(p.optional || f, node, p, "is missing");
}
void check(const Phased& f, std::string_view node, const Parameter& p) {
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
void check(PhaseSet set, std::string_view node, const Parameter& p) {
    require(p.optional || !set.empty(), node, p, "must not be empty");
}
template <class Content>
void check(const FromFile<Content>& file, std::string_view node, const Parameter& p) {
    require(p.optional || file.content != nullptr, node, p, "is missing");
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

template <class Node>
std::shared_ptr<const FieldNode> make_field(void* source) {
    Node& node = *static_cast<Node*>(source);
    const std::size_t depth = checked_depth(node);
    return std::make_shared<const FieldNode>(FieldNode{std::move(node), depth});
}

template <class Node>
std::shared_ptr<const PhasedNode> make_phased(void* source) {
    Node& node = *static_cast<Node*>(source);
    const std::size_t depth = checked_depth(node);
    const PhaseSet phases = phases_of(node);
    return std::make_shared<const PhasedNode>(PhasedNode{std::move(node), depth, phases});
}

template <class Made>
using Makers = std::unordered_map<std::type_index, std::shared_ptr<const Made> (*)(void*)>;

template <class... Nodes>
Makers<FieldNode> field_makers(TypeList<Nodes...>) {
    return {{typeid(Nodes), &make_field<Nodes>}...};
}
template <class... Nodes>
Makers<PhasedNode> phased_makers(TypeList<Nodes...>) {
    return {{typeid(Nodes), &make_phased<Nodes>}...};
}

template <class Made>
std::shared_ptr<const Made> made_by(const Makers<Made>& makers, const std::type_info& type, void* node) {
    const auto maker = makers.find(type);
    if (maker == makers.end()) throw std::logic_error("a node that is not in the list of nodes");
    return maker->second(node);
}

}  // namespace

std::shared_ptr<const FieldNode> detail::make_field_node(const std::type_info& type, void* node) {
    static const Makers<FieldNode> makers = field_makers(FieldNodes());
    return made_by(makers, type, node);
}

std::shared_ptr<const PhasedNode> detail::make_phased_node(const std::type_info& type, void* node) {
    static const Makers<PhasedNode> makers = phased_makers(PhasedNodes());
    return made_by(makers, type, node);
}

}  // namespace phasetree
