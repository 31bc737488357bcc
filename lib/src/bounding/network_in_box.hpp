#pragma once

#include <array>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox;

/// Bounds a neural field in a box. `data` is that of Siren::Network, and the box must lie within the network's cube.
///
/// Layer by layer, z = W·h + b and h = sin z, each neuron has its Taylor polynomial of degree three about the box's
/// centre. It is exact up to rounding errors, so terms that cancel between neurons do cancel; interval arithmetic from
/// layer to layer would add them up. Only the fourth derivatives along lines are bounded by sums of absolute values:
///     |h⁗| ≤ |cos z|·(q + 6g²k) + |sin z|·(4gt + 3k² + g⁴),
/// where g, k, t and q bound the first to fourth derivatives of z in the box. Each of the first three bounds is the
/// norm of the derivative at the centre, plus what the derivatives of higher order contribute within the box's radius.
FieldInBox network_in_box(const float* data, const std::array<double, 3>& centre, const std::array<double, 3>& half);

}  // namespace phasetree::bounding
