// Where the solid of a formula is.
#pragma once

#include "model/preparation.hpp"
#include "nodes/formula_box.hpp"
#include "nodes/formula_terms.hpp"

namespace phasetree::nodes {

/// A box around what of the solid is in a box: the box around those of its sub-boxes in which the formula may be
/// negative. It is the whole box if there are none. `steps` is how many operations the formula has; `budget` throws
/// when it is used up.
BoxOfDoubles around_solid(const FormulaTerms& formula, const BoxOfDoubles& whole, std::uint64_t steps,
                          model::Preparation& budget);

}  // namespace phasetree::nodes
