// How steep a term of a formula is. Over a box its gradient lies between bounds (src/enclosure). If the bound of the
// steepest box is more than two per cent above the steepest gradient that was seen at the middle of any box, that box
// is divided, and so on, until the two are near each other or so many boxes as are allowed have been examined. If a
// box has no bound when it is tiny, or when no more boxes are allowed, the formula is rejected, with the middle of that
// box.
#pragma once

#include "model/preparation.hpp"
#include "nodes/formula_box.hpp"
#include "nodes/formula_terms.hpp"

namespace phasetree::nodes {

/// What an operation of interval arithmetic costs of a Preparation's budget.
inline constexpr std::uint64_t work_of_a_step = 20;

/// A bound of a term's slope in a box, by at most this many boxes. Throws TextError, with the place in the text, where
/// there is none. `has_bounds` says whether the author gave the box: only the error's words depend on it. `budget`
/// throws when it is used up.
double slope_in(const TermSteps& term, const BoxOfDoubles& whole, int most_boxes, bool has_bounds,
                model::Preparation& budget);

}  // namespace phasetree::nodes
