// Instructions that occur only in the programs of cells (rewriting/fuse.hpp): a primitive fused with the affine maps
// before and after it, with the same rounding as the separate instructions. Their operations follow those of the maps
// of space: first an affine map alone, then one operation for each primitive.
#pragma once

#include <array>
#include <cstring>

#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// The constants of scale · d(map(p)) + offset. The constants of the primitive d follow.
struct PlacedPrimitive {
    AffineMap map;
    float scale = 1, offset = 0;
};
inline constexpr std::size_t placed_floats = sizeof(PlacedPrimitive) / sizeof(float);

inline constexpr std::uint32_t first_map = static_cast<std::uint32_t>(Op::first_primitive) +
                                           static_cast<std::uint32_t>(Primitives::size + DataPrimitives::size);
inline constexpr std::uint32_t affine_map = first_map + static_cast<std::uint32_t>(PointMaps::size);
inline constexpr std::uint32_t first_placed = affine_map + 1;

}  // namespace phasetree::program
