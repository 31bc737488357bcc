#pragma once

#include <optional>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox, enclosure::Interval;

/// What is known about the interpolation of a grid's voxels in a box.
struct VoxelsInBox {
    Interval values{};                  ///< of all voxels in the blocks that are relevant in the box
    std::optional<FieldInBox> field{};  ///< if few voxels are relevant
};

/// Bounds the interpolation of the voxels of a table (VoxelGrid) in a box, either trilinear or by a spline. The
/// interpolated value is an average of voxel values, its derivatives are averages of the differences between
/// neighbours, and its second derivatives averages of differences of these. A trilinear interpolation has second
/// derivatives only within a single cell between eight voxels.
VoxelsInBox voxels_in_box(const float* table, const PointRange&, bool is_spline);

}  // namespace phasetree::bounding
