#pragma once

#include "building/candidate.hpp"

namespace phasetree::building {

/// Below this share of a pattern's period a box is small enough that something is known of the pattern in it.
inline constexpr float known_share_of_period = 0.5f;

/// Whether nothing is known of a pattern in a node's cell because its box is larger than the pattern's features.
/// Components have slopes of at most 1, so a linear bound that is off by 1 tells nothing of them.
inline bool is_pattern_unknown(const BuildNode& node) {
    return !(node.cell.facts.bound.spread < 1) && node.box.diagonal() > known_share_of_period * node.pattern_period;
}

/// Whether boxes as small as a pattern's features may cost rays less than the node as one cell, by a trial: of the
/// node's children the one of middle cost is divided, of its children again one, and so on, until the boxes tried are
/// cheaper than the node or the pattern is known in them. Each box of a level is taken to save as much as the one tried
/// of that level. That is a guess, but it takes some dozens of boxes, while the interface may have millions of the
/// pattern's features.
bool may_gain_by_known_pattern(const BuildNode&, const BuildContext&, Worker&);

}  // namespace phasetree::building
