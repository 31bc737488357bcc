#pragma once

#include <span>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// The same object with other indices for its phases: phase i becomes numbers[i]. The vacuum stays 0. Subtrees that
/// are shared stay shared, and what has no phases in it is not copied. Throws ModelError if a phase of the tree has no
/// number, if two would have the same, or if a number is none of a phase other than the vacuum.
Phased renumbered(const Phased&, std::span<const Phase> numbers);
/// The same for a field, which may be made of objects.
Field renumbered(const Field&, std::span<const Phase> numbers);

}  // namespace phasetree
