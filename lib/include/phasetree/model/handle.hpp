#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <utility>

#include "phasetree/math/bounds.hpp"
#include "phasetree/math/vec3.hpp"
#include "phasetree/model/bounds_query.hpp"
#include "phasetree/model/parameter.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree {

struct FieldNode;
struct PhasedNode;

/// A node with an impossible parameter: what() says which and why.
class ModelError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

namespace detail {
/// The handle's content, moved out of the node that `node` points to, which is of this type: one of the list of nodes.
/// The library alone knows what holds any of them, so that who makes a few needs their headers and no other.
std::shared_ptr<const FieldNode> make_field_node(const std::type_info& type, void* node);
std::shared_ptr<const PhasedNode> make_phased_node(const std::type_info& type, void* node);
}  // namespace detail

/// A plain distance field: one 1-Lipschitz value, negative inside. A cheap handle of an immutable tree, shared when
/// copied; any thread may read it. Made from a node: `Field ball = Sphere{.radius = 2};`
/// Throws ModelError where the node's parameters are out of their limits.
class Field {
  public:
    Field() = default;
    template <class Node>
    requires requires { Node::is_field_node; }
    Field(Node node)  // NOLINT: conversion intended
        : node_(detail::make_field_node(typeid(Node), &node)) {}

    explicit operator bool() const { return node_ != nullptr; }
    const FieldNode* node() const { return node_.get(); }
    friend bool operator==(const Field&, const Field&) = default;

  private:
    std::shared_ptr<const FieldNode> node_;
};

/// A multiphase object: Φ = (φ₀ … φₙ), of which at most one component is negative anywhere. Handle like Field.
class Phased {
  public:
    Phased() = default;
    template <class Node>
    requires requires { Node::is_phased_node; }
    Phased(Node node)  // NOLINT: conversion intended
        : node_(detail::make_phased_node(typeid(Node), &node)) {}

    explicit operator bool() const { return node_ != nullptr; }
    const PhasedNode* node() const { return node_.get(); }
    friend bool operator==(const Phased&, const Phased&) = default;

  private:
    std::shared_ptr<const PhasedNode> node_;
};

/// A box around the points where the field is not positive. Infinite where the field is.
Bounds bounds(const Field&);
/// A box around everything that is not vacuum.
Bounds bounds(const Phased&);

/// The phases that the object may have anywhere; bit 0 tells whether vacuum is one of them.
PhaseSet phases(const Phased&);

/// Φ by walking the tree with arrays of phases, as the paper does: slow and obvious, the definition that the fast
/// evaluators are tested against.
float distance(const Field&, const glm::vec3& p);
Phases<float> distances(const Phased&, const glm::vec3& p);

/// μ(p): the phase of the smallest component, vacuum included; of equal ones the lowest index.
Phase label(const Phases<float>&);

struct TreeStatistics {
    std::size_t nodes = 0;  ///< shared subtrees counted once
    std::size_t depth = 0;
    std::size_t bytes = 0;  ///< what the tree takes in memory
};
TreeStatistics statistics(const Field&);
TreeStatistics statistics(const Phased&);

/// Deeper trees are refused: everything that walks a tree recurses.
inline constexpr std::size_t max_tree_depth = 400;

}  // namespace phasetree
