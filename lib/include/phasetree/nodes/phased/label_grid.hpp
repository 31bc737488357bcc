#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree {

/// Whole numbers at voxels, as in a segmented scan. The user of the grid maps numbers to phases.
struct LabelGrid {
    /// The limits of readers and nodes: 512³, and as many different numbers as the table has indices for.
    static constexpr std::size_t most_voxels = std::size_t{1} << 27, most_numbers = 256;

    VoxelLattice lattice{};
    /// Whether the lattice says how large the voxels are, as an OpenVDB file does and images do not.
    bool has_spacing = false;
    std::vector<std::int32_t> numbers{};  ///< those that occur
    std::vector<std::uint8_t> voxels{};   ///< the index in `numbers` of each voxel, x fastest, then y

    std::size_t bytes() const { return voxels.size() + numbers.size() * sizeof(numbers[0]); }
};

}  // namespace phasetree
