#pragma once

#include <functional>
#include <span>
#include <variant>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// Called for each node that is recreated, with the address of the original and the new node.
using NodeCopied = std::function<void(const void* of, const std::variant<Field, Phased>& copy)>;

/// The same object with other indices for its phases: phase i becomes numbers[i]. The vacuum stays 0. Subtrees that
/// are shared stay shared, and what has no phases in it is not copied. Throws ModelError if a phase of the tree has no
/// number, if two would have the same, or if a number is none of a phase other than the vacuum.
Phased renumbered(const Phased&, std::span<const Phase> numbers, const NodeCopied& = {});
/// The same for a field, which may be made of objects.
Field renumbered(const Field&, std::span<const Phase> numbers, const NodeCopied& = {});

}  // namespace phasetree
