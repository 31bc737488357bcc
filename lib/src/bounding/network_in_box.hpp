#pragma once

#include <array>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox;

/// Of a network as Siren::Network has it in its data, without its cube: the box must lie within that.
///
/// Layer by layer z = W·h + b, h = sin z, with each neuron's Taylor polynomial of degree three about the centre; that
/// is exact, so that whatever cancels between neurons does. Only the fourth derivatives along lines are bounded, by
/// sums of absolute values:
///     |h⁗| ≤ |cos z|·(q + 6g²k) + |sin z|·(4gt + 3k² + g⁴),
/// where g, k, t and q bound z's derivatives of order one to four within the radius of the box: the first three what
/// they are at the centre and what the following ones add.
FieldInBox network_in_box(const float* data, const std::array<double, 3>& centre, const std::array<double, 3>& half);

}  // namespace phasetree::bounding
