#pragma once

#include <array>

namespace phasetree {

/// A box of points, given by its centre and by its reach, which is half its size along each axis.
struct PointRange {
    std::array<double, 3> centre{}, reach{};
};

}  // namespace phasetree
