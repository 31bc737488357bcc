#pragma once

#include <functional>
#include <span>
#include <variant>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// Called for each node that is recreated, with the address of the original and the new node.
using NodeCopied = std::function<void(const void* of, const std::variant<Field, Phased>& copy)>;

/// Renumber the phases of an object: phase i becomes numbers[i]. The vacuum stays 0. Shared subtrees stay shared, and
/// subtrees without phases are not copied.
///
/// Throws ModelError if a phase of the tree has no number, if two phases would get the same number, or if a number is 0
/// (the vacuum) or not less than Phase::capacity.
Phased renumbered(const Phased&, std::span<const Phase> numbers, const NodeCopied& = {});
/// The same for a field, which may be made of objects.
Field renumbered(const Field&, std::span<const Phase> numbers, const NodeCopied& = {});

}  // namespace phasetree
