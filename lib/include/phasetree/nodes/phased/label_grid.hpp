#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree {

/// Integer labels at voxels, as in a segmented scan. The user of the grid maps labels to phases.
struct LabelGrid {
    /// The maxima that file readers and nodes accept: 512³ voxels, and 256 distinct labels, because indices are bytes.
    static constexpr std::size_t max_voxels = std::size_t{1} << 27, max_numbers = 256;

    VoxelLattice lattice{};
    /// Whether the lattice defines the size of the voxels. True for OpenVDB files, false for images.
    bool has_spacing = false;
    std::vector<std::int32_t> numbers{};  ///< the distinct labels
    std::vector<std::uint8_t> voxels{};   ///< index in `numbers` of each voxel, x fastest, then y

    std::size_t bytes() const { return voxels.size() + numbers.size() * sizeof(numbers[0]); }
};

template <>
struct FileFormat<LabelGrid> {
    static constexpr std::string_view no_reader = "this program can read neither OpenVDB files nor images";
};

}  // namespace phasetree
