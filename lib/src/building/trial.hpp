#pragma once

#include "building/candidate.hpp"

namespace phasetree::building {

/// In a box smaller than this fraction of a pattern's period, something is known about the pattern.
inline constexpr float known_share_of_period = 0.5f;

/// Whether nothing is known about a pattern in a node's cell, because its box is larger than the pattern's features.
/// Components have slopes of at most 1, so a linear bound with a spread of 1 says nothing about them.
inline bool is_pattern_unknown(const BuildNode& node) {
    return !(node.cell.facts.bound.spread < 1) && node.box.diagonal() > known_share_of_period * node.pattern_period;
}

/// Tests whether boxes as small as a pattern's features may cost rays less than the node as one cell. The trial divides
/// the child of median cost, then one of its children, and so on, until the boxes tried are cheaper than the node or
/// the pattern is known in them. Every box of a level is assumed to save as much as the one tried on that level. That
/// is a guess, but it takes a few dozen boxes, while the interface may have millions of the pattern's features.
bool may_gain_by_known_pattern(const BuildNode&, const BuildContext&, Worker&);

}  // namespace phasetree::building
