#pragma once

/// A glass of water, in which the water is modelled exactly, too large, or too small.

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/phased/close_gaps.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree::tests::glass_of_water {

inline constexpr Phase glass{1}, water{2};
/// The cavity of the glass is a cylinder about the z axis that begins at z = 0.
inline constexpr float radius = 0.3f, wall = 0.06f, rim = 0.8f, level = 0.5f;
/// The excess or deficit of the water, and the gap that is closed.
inline constexpr float excess = 0.008f, gap = 0.02f;

inline Field cylinder(float r, float low, float high) {
    return warped(Translate{{0, 0, 0.5f * (low + high)}}, Field(Cylinder{.radius = r, .height = high - low}));
}
inline Field hollow() {
    return Difference{.from = cylinder(radius + wall, -wall, rim), .subtract = {cylinder(radius, 0, rim + 1)}};
}
/// The glass, and the water, which replaces only the vacuum.
inline Phased filled(const Field& vessel, const Field& liquid) {
    return Over{.of = {Set{.phase = glass, .of = vessel}, Set{.phase = water, .of = liquid}}};
}
/// The walls of the water are those of the cavity, to the last bit.
inline Phased exact() {
    return filled(hollow(), cylinder(radius, 0, level));
}
/// Water that exceeds the cavity by a positive or negative length on all sides except its surface. It is rotated, so
/// that its walls are rounded differently from those of the glass.
inline Field water_larger_by(float length) {
    return warped(Rotate{.axis = {0, 0, 1}, .angle = 33}, cylinder(radius + length, -length, level));
}
inline Phased closed(Phased object) {
    return CloseGaps{.of = std::move(object), .of_phases = {water, glass}, .gap = gap};
}
/// The distance of a point from the circle where glass, water and vacuum meet.
inline float distance_to_rim_of_water(const glm::vec3& p) {
    return std::hypot(std::hypot(p.x, p.y) - radius, p.z - level);
}

}  // namespace phasetree::tests::glass_of_water
