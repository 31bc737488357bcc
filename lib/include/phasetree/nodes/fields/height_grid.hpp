#pragma once

#include <cstddef>
#include <vector>

#include "phasetree/model/from_file.hpp"

namespace phasetree {

/// Heights on a rectangular grid, from 0 to 1. Stored row by row; the first row is at the largest y, as in an image
/// seen from above.
struct HeightGrid {
    int width = 0, height = 0;
    std::vector<float> values;

    std::size_t bytes() const { return values.size() * sizeof(float); }
};

template <>
struct FileFormat<HeightGrid> {
    static constexpr std::string_view no_reader = "this program cannot read images";
};

}  // namespace phasetree
