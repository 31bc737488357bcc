#pragma once

#include <array>
#include <cstring>

#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"

/// Instructions that only cells have (rewriting/fuse.hpp): what is affine before a
/// primitive and after it, in one with it, rounded as it would be alone.
/// Their operations follow those of the maps of space: first a map alone, then one for each primitive.
namespace phasetree::program {

/// scale · d(map(p)) + offset: the floats of d follow.
struct PlacedPrimitive {
    AffineMap map;
    float scale = 1, offset = 0;
};
inline constexpr std::size_t placed_floats = sizeof(PlacedPrimitive) / sizeof(float);

inline constexpr std::uint32_t first_map = static_cast<std::uint32_t>(Op::first_primitive) +
                                           static_cast<std::uint32_t>(Primitives::size + DataPrimitives::size);
inline constexpr std::uint32_t affine_map = first_map + static_cast<std::uint32_t>(PointMaps::size);
inline constexpr std::uint32_t first_placed = affine_map + 1;
/// The map that folds space.
inline constexpr Op fold_map = static_cast<Op>(first_map + static_cast<std::uint32_t>(index_in<FoldMap>(PointMaps())));

}  // namespace phasetree::program
