// How steep a term of a formula is. Over a box its gradient lies between bounds (src/enclosure). Where they are far
// above what the gradient at the box's middle is, the box is divided, the steepest part first, until little is to be
// gained. A part so small that it says nothing any more, and still without bound, is a place where there is none: the
// formula is refused.
#pragma once

#include "model/preparation.hpp"
#include "nodes/formula_box.hpp"
#include "nodes/formula_terms.hpp"

namespace phasetree::nodes {

/// What an operation of interval arithmetic costs of a Preparation's budget.
inline constexpr std::uint64_t work_of_a_step = 20;

/// A bound of a term's slope in a box, by at most so many boxes. Throws TextError, with the place in the text, where
/// there is none. `has_bounds` says whether the author gave the box: only the error's words depend on it. `budget`
/// throws when it is used up.
double slope_in(const TermSteps& term, const BoxOfDoubles& whole, int most_boxes, bool has_bounds,
                model::Preparation& budget);

}  // namespace phasetree::nodes
