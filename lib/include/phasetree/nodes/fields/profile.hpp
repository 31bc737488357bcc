// Shared code of primitives made from a plane profile.
#pragma once

#include <initializer_list>
#include <string>

#include "phasetree/model/concepts.hpp"

namespace phasetree::detail {

/// A rectangle in the plane, grown by d (or shrunk if d is negative), extended along all z.
inline Bounds at_every_height(const Bounds& b, float d) {
    return {{b.low.x - d, b.low.y - d, -Bounds::infinity}, {b.high.x + d, b.high.y + d, Bounds::infinity}};
}

/// Throw ModelError if the square or reciprocal of a size comes near the limits of floats.
inline void require_usable(std::string_view node, std::initializer_list<float> sizes) {
    for (const float s : sizes)
        if (!(std::abs(s) >= 1e-9f && std::abs(s) <= 1e9f))
            throw ModelError(std::string(node) + ": its sizes must be between 1e-9 and 1e9 m");
}

}  // namespace phasetree::detail
