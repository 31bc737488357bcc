// Bounds the slope of a formula's term. In each box, enclosures bound the gradient (src/enclosure). While the bound in
// the steepest box is more than two per cent above the steepest gradient found at the centre of any box, that box is
// divided. The search ends when the two agree, or when the allowed number of boxes has been examined. If a box has no
// bound when it is tiny, or when the boxes are used up, the formula is rejected, and the message gives the centre of
// that box.
#pragma once

#include "model/preparation.hpp"
#include "nodes/formula/box.hpp"
#include "nodes/formula/terms.hpp"

namespace phasetree::nodes {

/// The cost of an operation of interval arithmetic in a Preparation's budget.
inline constexpr std::uint64_t work_of_a_step = 20;

/// An upper bound on a term's slope in a box, using at most this many boxes. If there is none, throws TextError with
/// the position in the text. `has_bounds` says whether the author specified the box; it only affects the message.
/// `budget` throws when it is used up.
double slope_in(const TermSteps& term, const BoxOfDoubles& whole, int max_boxes, bool has_bounds,
                model::Preparation& budget);

}  // namespace phasetree::nodes
