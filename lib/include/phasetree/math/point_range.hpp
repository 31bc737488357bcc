#pragma once

#include <array>

namespace phasetree {

/// A box of points, given by its centre and half its size along each axis.
struct PointRange {
    std::array<double, 3> centre{}, half_extents{};
};

}  // namespace phasetree
