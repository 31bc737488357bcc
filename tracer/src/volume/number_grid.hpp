// Numbers at voxels of which there is none below 0, such as densities and temperatures.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::tracer {

// Simulations leave values a little below 0. What is no number stays that, and is rejected with its place.
inline float number_at_voxel(float value) {
    return value < 0.0f ? 0.0f : value;
}

inline VoxelGrid number_grid(const VoxelLattice& lattice, std::vector<float> values) {
    std::ranges::transform(values, values.begin(), number_at_voxel);
    return VoxelGrid::of_values("voxels", lattice, values);
}

}  // namespace phasetree::tracer
