#pragma once

#include <array>
#include <limits>

#include "phasetree/math/bounds.hpp"

namespace phasetree::measuring {

/// The integrals over a solid of 1, of the coordinates x, y, z, and of the products xx, yy, zz, yz, xz, xy.
using Moments = std::array<double, 10>;

/// The index of a product of two coordinates in Moments.
inline constexpr std::size_t product_index(std::size_t i, std::size_t j) {
    return i == j ? 4 + i : 10 - i - j;
}

/// A box in double precision. Its coordinates are relative to a local origin.
struct MeasuredBox {
    std::array<double, 3> low{}, size{};

    MeasuredBox(const Bounds& box, const std::array<double, 3>& origin) {
        for (std::size_t i = 0; i < 3; ++i) {
            const int k = static_cast<int>(i);
            low[i] = static_cast<double>(box.low[k]) - origin[i];
            size[i] = static_cast<double>(box.high[k]) - static_cast<double>(box.low[k]);
        }
    }
    double volume() const { return size[0] * size[1] * size[2]; }
    double high(std::size_t i) const { return low[i] + size[i]; }
    Moments moments() const;
};

/// A part of a box: its moments and its extent, which is empty (low > high) if the part is.
struct PartOfBox {
    Moments moments{};
    std::array<double, 3> low, high;

    PartOfBox() {
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
    }
    /// The whole box.
    explicit PartOfBox(const MeasuredBox&);
};

/// A linear function in a box, by its value at the low corner and its change along each side.
struct LinearInBox {
    double at_low = 0;
    std::array<double, 3> change{};

    LinearInBox plus(double v) const { return {at_low + v, change}; }
};

/// The part of a box in which a linear function is negative. The error of each moment is at most 10⁻¹² times the box's
/// volume times the largest absolute value of the moment's integrand in the box.
PartOfBox part_below(const LinearInBox&, const MeasuredBox&);

}  // namespace phasetree::measuring
