#pragma once

#include <optional>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox, enclosure::Range;

/// What is known in a box of the interpolation of a grid's voxels.
struct VoxelsInBox {
    Range values{};                     ///< of all voxels of the blocks that count in the box
    std::optional<FieldInBox> field{};  ///< if few voxels count
};

/// Bounds the interpolation of the voxels of a table (VoxelGrid) in a box: the trilinear one, or the spline. Both are
/// averages of the voxels' values, their derivatives of the differences between neighbours, and their second
/// derivatives of differences of these. A trilinear interpolation has second derivatives within a cell between eight
/// voxels alone.
VoxelsInBox voxels_in_box(const float* table, const PointRange&, bool is_spline);

}  // namespace phasetree::bounding
