#pragma once

#include <array>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox;

/// Bounds a neural field in a box. `data` are those of Siren::Network, and the box must lie within the network's cube.
///
/// Each neuron, layer by layer z = W·h + b and h = sin z, has its Taylor polynomial of degree three about the box's
/// centre. It is computed exactly but for rounding errors, so that what cancels between neurons does cancel, while
/// interval arithmetic from layer to layer would add it up. Only the fourth derivatives along lines are bounded, by
/// sums of absolute values:
///     |h⁗| ≤ |cos z|·(q + 6g²k) + |sin z|·(4gt + 3k² + g⁴),
/// where g, k, t and q bound the first to fourth derivatives of z in the box. The first three of these bounds are the
/// derivative's norm at the centre and what the derivatives of higher order add to it within the box's radius.
FieldInBox network_in_box(const float* data, const std::array<double, 3>& centre, const std::array<double, 3>& half);

}  // namespace phasetree::bounding
