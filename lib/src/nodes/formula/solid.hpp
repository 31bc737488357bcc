// Finds where the solid of a formula is.
#pragma once

#include "model/preparation.hpp"
#include "nodes/formula/box.hpp"
#include "nodes/formula/terms.hpp"

namespace phasetree::nodes {

/// A box around the part of the solid within a box: the union of the sub-boxes in which the formula may be negative, or
/// the whole box if there are none. `steps` is the number of operations of the formula; `budget` throws when it is used
/// up.
BoxOfDoubles around_solid(const FormulaTerms& formula, const BoxOfDoubles& whole, std::uint64_t steps,
                          model::Preparation& budget);

}  // namespace phasetree::nodes
