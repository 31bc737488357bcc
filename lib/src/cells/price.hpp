#pragma once

#include <algorithm>

#include "cells/linear_bound.hpp"
#include "cells/prune.hpp"

namespace phasetree {

/// What rays spend in a cell, in nanoseconds for each unit of surface (which is how many come, up to a factor). Rough:
/// only what is dearer than what matters.
namespace price {
inline constexpr float parts = 12;               ///< of Embree's going down to the parts of a box
inline constexpr float visit = 45;               ///< of entering a cell
inline constexpr float batch = 25, step = 4.5f;  ///< of a batch, and of each of its instructions
inline constexpr float certain = 1.5f;           ///< batches where the field is linear,
inline constexpr float unknown = 0.5f;           ///< more of them the less it lets rays pass without one,
inline constexpr float uneven = 1;               ///< and the more its gradient varies
}  // namespace price

/// How much work a program is, in simple instructions.
inline float work(const WorkingProgram& program) {
    constexpr auto first = static_cast<std::uint32_t>(Op::first_primitive);
    float sum = 0;
    for (const Instruction& in : program.code.subspan(1)) {
        const auto op = static_cast<std::uint32_t>(in.op);
        sum += op < first ? 1.f : is_long_primitive(in.op) ? 60.f : 1.5f;
    }
    return sum;
}

inline float surface(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

inline float cost(const Bounds& box, const LinearBound& bound, float steps) {
    float unknown = 3, spread = 1;
    if (bound.slack < Bounds::infinity) {
        const float thickness = 0.5f * glm::dot(glm::abs(bound.normal), box.extent());
        unknown = std::min(1.f, bound.slack / std::max(thickness, 1e-30f));
        spread = std::min(1.f, bound.spread);
    }
    const float batches = price::certain + price::unknown * unknown + price::uneven * spread;
    return surface(box) * (price::visit + batches * (price::batch + price::step * steps));
}
/// A cell of this size cannot cost less.
inline float least_cost(const Bounds& box) {
    return surface(box) * (price::visit + price::certain * (price::batch + price::step));
}

}  // namespace phasetree
