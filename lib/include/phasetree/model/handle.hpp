#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
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

/// Thrown for a tree that is invalid or unusable for the requested task, such as a node with an invalid parameter or an
/// unbounded object, and for arguments out of range. what() says what is wrong.
class ModelError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

namespace detail {
/// Make the content of a handle from the node that `node` points to. The node has the given type, and is moved from.
/// Only the library knows the variant over all nodes, so a program needs only the headers of the nodes that it uses.
std::shared_ptr<const FieldNode> make_field_node(const std::type_info& type, void* node);
std::shared_ptr<const PhasedNode> make_phased_node(const std::type_info& type, void* node);
}  // namespace detail

/// A distance field: one 1-Lipschitz value in the scene's unit of length, negative inside.
///
/// This is a handle to an immutable tree: cheap to copy, and safe to read from any thread. It is made from a node,
/// `Field ball = Sphere{.radius = 2};`, which throws ModelError if a parameter of the node is outside its limits. A
/// default-constructed handle is empty and must not be evaluated.
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

/// A multiphase object: a tree of distances Φ = (φ₀ … φₙ), of which at most one is negative at any point. A handle like
/// Field. (Phases<float> holds the values of Φ at a point; a PhaseSet is a set of indices of phases.)
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

/// A box around the points where the field is not positive. Sides are infinite where the field is unbounded.
Bounds bounds(const Field&);
/// A box around everything that is not vacuum.
Bounds bounds(const Phased&);

namespace detail {
/// Throw ModelError because a part of a node must be bounded but is not. The message names the nodes that make it
/// unbounded. `what` starts the message: "twist: the child". `end` ends it; by default, it says how to bound the part.
[[noreturn]] void throw_unbounded(std::string_view what, const Field& part, std::string_view end = {});
[[noreturn]] void throw_unbounded(std::string_view what, const Phased& part, std::string_view end = {});
}  // namespace detail

/// The phases that can occur in the object. Bit 0 is set if the vacuum is one of them.
PhaseSet phases(const Phased&);

/// The values at a point, computed by walking the tree with arrays of phases, as in the paper (Galin et al., *The
/// PhaseTree*, SIGGRAPH 2026). Slow: this is the reference that the fast evaluators are tested against.
float distance(const Field&, const glm::vec3& p);
Phases<float> distances(const Phased&, const glm::vec3& p);

/// The label μ(p): the phase of the smallest component, including the vacuum. Among equal components, the lowest index.
Phase label(const Phases<float>&);

struct TreeStatistics {
    std::size_t nodes = 0;  ///< shared subtrees are counted once
    std::size_t depth = 0;
    std::size_t bytes = 0;  ///< memory of the tree
};
TreeStatistics statistics(const Field&);
TreeStatistics statistics(const Phased&);

/// The maximum depth of a tree. Functions that walk a tree recurse, so deeper trees are rejected with a ModelError.
inline constexpr std::size_t max_tree_depth = 400;

}  // namespace phasetree
