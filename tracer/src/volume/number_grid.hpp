// Non-negative numbers at voxels, such as densities and temperatures.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::tracer {

// Clamps to 0, because simulations leave slightly negative values. NaN is kept, so that it is rejected with its
// position.
inline float number_at_voxel(float value) {
    return value < 0.0f ? 0.0f : value;
}

inline VoxelGrid number_grid(const VoxelLattice& lattice, std::vector<float> values) {
    std::ranges::transform(values, values.begin(), number_at_voxel);
    return VoxelGrid::of_values("voxels", lattice, values);
}

}  // namespace phasetree::tracer
