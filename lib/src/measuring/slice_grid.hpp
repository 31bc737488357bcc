#pragma once

#include <cstdint>
#include <vector>

#include "phasetree/measuring/slice.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::measuring {

/// A square of the grid, by its column and row.
struct GridSquare {
    std::uint32_t column = 0, row = 0;
    auto operator<=>(const GridSquare&) const = default;
};

/// The grid of squares in which outlines are found: 2ⁿ along each side. Its lines are where repeated halving of the
/// whole puts them, because squares are examined in this way.
struct SliceGrid {
    SlicePlane plane;
    Bounds bounds;  ///< of the object, with a margin of vacuum
    float resolution = 0;
    int levels = 0;
    double side = 0;                   ///< of a square
    std::vector<float> columns, rows;  ///< the coordinates of its lines

    /// Throws ModelError; see slice().
    SliceGrid(const TraceableObject&, const SlicePlane&, double tolerance);

    std::uint32_t count() const { return std::uint32_t{1} << levels; }
    /// The maximum length of the bounds, in squares. The grid is longer, because its first line lies before the bounds.
    double squares_across() const { return static_cast<double>(count()) - 2; }
    /// The whole grid, as a flat box.
    Bounds whole() const;
    bool meets_bounds(const glm::vec2& low, const glm::vec2& high) const;
};

/// The finest tolerance that 32-bit coordinates allow.
double finest_slice_tolerance(const TraceableObject&);

/// The squares that are not proven to be in one phase, in ascending order. Throws ModelError and SlicingCancelled.
std::vector<GridSquare> squares_in_doubt(const Phased& object, const SliceGrid&, const SliceOptions&);

}  // namespace phasetree::measuring
