#pragma once

#include <optional>

#include "enclosure/enclosure.hpp"

namespace phasetree::bounding {

/// Encloses the distance to a few balls, given as a balls::ShortList, at a point q that is known as a function of a
/// box's points. The result is the minimum of their enclosures; nullopt if there are more than a few. `half` contains
/// the box's half extents.
std::optional<enclosure::Enclosure> balls_in_box(const float* list, const Vec3<enclosure::Enclosure>& q,
                                                 const enclosure::Enclosure::Vector& half);

}  // namespace phasetree::bounding
