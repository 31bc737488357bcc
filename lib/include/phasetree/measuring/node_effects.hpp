// Effects of nodes: whether leaving out a node of a tree changes the object.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// "proved", "refuted" or "undecided".
enum class Verdict { proved, refuted, undecided };
std::string_view name_of(Verdict);

/// A node of a tree.
using AnyNode = std::variant<Field, Phased>;
/// The node's name in scene files, such as "sphere".
std::string_view name_of(const AnyNode&);
/// The address by which NodePlaces finds the node.
const void* address_of(const AnyNode&);

/// A point where labels differ.
struct LabelChange {
    glm::vec3 point;
    Phase with, without;  ///< the labels with the node and without it
};

/// What leaving out one node changes, while all others stay.
struct NodeEffect {
    AnyNode node;    ///< that is left out
    AnyNode parent;  ///< from which the node is left out; the node itself if its operand `kept` replaces it
    std::optional<AnyNode> kept{};
    Phased without{};                      ///< the object without the node; empty if it was not examined
    Verdict is_dead = Verdict::undecided;  ///< whether all labels stay the same
    std::optional<LabelChange> change{};   ///< if the node is not dead: a point where the labels differ
    bool is_replaced() const { return kept && address_of(node) == address_of(parent); }
};

struct NodeEffectsOptions {
    std::size_t max_boxes = std::size_t{1} << 14;  ///< for each node
    double seconds =
        std::numeric_limits<double>::infinity();  ///< time limit, positive; nodes not decided by then stay undecided
    std::function<bool()> cancelled{};            ///< polled from any thread; return true to get what is known so far
    std::function<void(float)> progress{};        ///< receives the fraction of the nodes that are done
};

/// Find out for each node of an object whether it is *dead*: whether the object has the same label at every point
/// without it. There are three ways to leave out a node:
///
/// * Items of lists, such as the operands of a union, are removed.
/// * An operation with a main operand and others is replaced by its main operand: `subtract_shape`, for example, by the
///   object that it cuts. If there is one other operand, here the shape, that one counts as left out, otherwise the
///   operation.
/// * An operation with a single operand, such as a translation, is replaced by this operand.
///
/// Both trees are divided into the same boxes. A box is done if both trees prune to the same program in it, or if it
/// certainly lies in the same phase in both. So a dead node is proved dead everywhere, and a node that changes a label
/// is refuted by a point at which both labels are certain, up to the rounding errors that measure() allows for.
///
/// A shared subtree, which occurs in several places of the tree, is left out of all of them. If two nodes are equal,
/// each is dead as long as the other one stays. Nodes below a dead one are not examined.
///
/// Uses all threads of TBB's arena. Results do not depend on their number, unless time ends the search or it is
/// cancelled. Throws ModelError if the object is empty or unbounded.
std::vector<NodeEffect> node_effects(const Phased& object, const NodeEffectsOptions& = {});

}  // namespace phasetree
