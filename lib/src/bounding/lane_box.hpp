#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "phasetree/math/bounds.hpp"

namespace phasetree::bounding {

/// A box in two vector registers, for code that spends its time cutting boxes. Along the fourth axis, which pads the
/// registers, it is the interval [0, 0]. The default is the empty box.
struct LaneBox {
    using Lanes [[gnu::vector_size(16)]] = float;

    Lanes low{Bounds::infinity, Bounds::infinity, Bounds::infinity, 0};
    Lanes high{-Bounds::infinity, -Bounds::infinity, -Bounds::infinity, 0};

    LaneBox() = default;
    LaneBox(const Lanes& l, const Lanes& h) : low(l), high(h) {}
    explicit LaneBox(const Bounds& b) : low{lanes(b.low)}, high{lanes(b.high)} {}

    static Lanes lanes(const glm::vec3& v) { return Lanes{v.x, v.y, v.z, 0}; }
    static Lanes each(float v) { return Lanes{v, v, v, v}; }

    Bounds bounds() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
    bool empty() const {
        const auto axes = std::bit_cast<std::array<std::uint64_t, 2>>(low <= high);
        return (axes[0] & axes[1]) != ~std::uint64_t{0};
    }
};

inline LaneBox unite(const LaneBox& a, const LaneBox& b) {
    return {a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}

}  // namespace phasetree::bounding
