#pragma once

#include <array>

namespace phasetree {

/// Where a point may be: about a centre, so far along each axis.
struct PointRange {
    std::array<double, 3> centre{}, reach{};
};

}  // namespace phasetree
