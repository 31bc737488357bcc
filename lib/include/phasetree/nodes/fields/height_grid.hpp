#pragma once

#include <cstddef>
#include <vector>

namespace phasetree {

/// Heights on a rectangular grid, from 0 to 1: row after row, the first at the largest y, as an image is seen from
/// above.
struct HeightGrid {
    int width = 0, height = 0;
    std::vector<float> values;

    std::size_t bytes() const { return values.size() * sizeof(float); }
};

}  // namespace phasetree
