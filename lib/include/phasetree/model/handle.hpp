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
/// Makes the content of a handle from the node that `node` points to, which is of the given type and is moved from.
/// Only the library knows the variant over all nodes, so that a program which makes a few needs no other headers than
/// theirs.
std::shared_ptr<const FieldNode> make_field_node(const std::type_info& type, void* node);
std::shared_ptr<const PhasedNode> make_phased_node(const std::type_info& type, void* node);
}  // namespace detail

/// A plain distance field: one 1-Lipschitz value in the scene's unit of length, negative inside. It is a cheap handle
/// of an immutable tree, which copies share; any thread may read it. It is made from a node, `Field ball =
/// Sphere{.radius = 2};`, and throws ModelError if a parameter of the node is out of its limits. A default-made handle
/// is empty and means nothing.
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

/// A multiphase object Φ = (φ₀ … φₙ), of which at most one component is negative at any point. It is a handle as Field
/// is.
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

/// A box around the points where the field is not positive; sides are infinite where the field has no bounds.
Bounds bounds(const Field&);
/// A box around all that is not vacuum.
Bounds bounds(const Phased&);

/// The phases that the object may have anywhere; bit 0 is set if vacuum is one of them.
PhaseSet phases(const Phased&);

/// The values at a point, by walking the tree with arrays of phases as the paper does. This is slow, and the definition
/// that the fast evaluators are tested against.
float distance(const Field&, const glm::vec3& p);
Phases<float> distances(const Phased&, const glm::vec3& p);

/// The label μ(p): the phase of the smallest component, the vacuum included; the lowest index among equal components.
Phase label(const Phases<float>&);

struct TreeStatistics {
    std::size_t nodes = 0;  ///< shared subtrees are counted once
    std::size_t depth = 0;
    std::size_t bytes = 0;  ///< that the tree takes in memory
};
TreeStatistics statistics(const Field&);
TreeStatistics statistics(const Phased&);

/// Deeper trees are rejected with a ModelError, because functions that walk a tree recurse.
inline constexpr std::size_t max_tree_depth = 400;

}  // namespace phasetree
