#include "phasetree/nodes/fields/voxel_grid.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "phasetree/model/handle.hpp"

namespace phasetree {

using voxels::Table;

namespace {

// The blocks of a grid with this many voxels; x varies fastest.
class Blocks {
  public:
    explicit Blocks(const std::array<int, 3>& size) {
        for (std::size_t i = 0; i < 3; ++i) along_[i] = (size[i] + VoxelGrid::block_side - 1) / VoxelGrid::block_side;
    }
    const std::array<int, 3>& along() const { return along_; }
    std::size_t count() const {
        std::size_t count = 1;
        for (const int n : along_) count *= static_cast<std::size_t>(n);
        return count;
    }
    std::array<int, 3> first_voxel(std::size_t block) const {
        std::array<int, 3> first;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<std::size_t>(along_[axis]);
            first[axis] = static_cast<int>(block % n) * VoxelGrid::block_side;
            block /= n;
        }
        return first;
    }

  private:
    std::array<int, 3> along_;  ///< the number of blocks along each axis
};

std::vector<float> head_of(const VoxelLattice& lattice) {
    std::vector<float> head;
    for (const int n : lattice.size) head.push_back(static_cast<float>(n));
    const Blocks blocks(lattice.size);
    for (const int n : blocks.along()) head.push_back(static_cast<float>(n));
    for (int i = 0; i < 3; ++i) head.push_back(static_cast<float>(lattice.first[i]));
    for (int i = 0; i < 3; ++i) head.push_back(static_cast<float>(1 / lattice.spacing[i]));
    return head;
}

void check(std::string_view who, const VoxelLattice& lattice) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (lattice.size[i] < 1) throw ModelError(fmt::format("{}: the grid is empty", who));
        if (lattice.size[i] > VoxelGrid::max_along_axis)
            throw ModelError(fmt::format("{}: the grid has {} voxels along an axis; the limit is {}", who,
                                         lattice.size[i], VoxelGrid::max_along_axis));
        const auto axis = static_cast<glm::length_t>(i);
        if (!(lattice.spacing[axis] >= 1e-9 && lattice.spacing[axis] <= 1e6) || !(std::abs(lattice.first[axis]) <= 1e9))
            throw ModelError(
                fmt::format("{}: the spacing of voxels must be from 1e-9 to 1e6 m, and their distance from the origin "
                            "at most 1e9 m",
                            who));
    }
}

ModelError too_many_values(std::string_view who) {
    return ModelError(fmt::format("{}: the grid has more than {} values that differ from their neighbours", who,
                                  VoxelGrid::max_values));
}

ModelError too_many_blocks(std::string_view who, const std::array<int, 3>& size, std::size_t count, std::size_t most) {
    return ModelError(fmt::format(
        "{}: the grid spans {} × {} × {} voxels, or {} blocks of 8 × 8 × 8 including empty ones, but the limit "
        "is {} blocks; crop it, split it, or resample it to larger voxels",
        who, size[0], size[1], size[2], count, most));
}

// The range of a block's values for the directory, and whether a value is invalid.
struct BlockRange {
    float low = 0, high = 0;
    bool has_bad_value = false;  // too large, or not a number

    explicit BlockRange(std::span<const float, VoxelGrid::kept_values> values) : low(values[0]), high(values[0]) {
        // Most blocks of a sparse grid are constant, and comparing their bytes is faster than comparing numbers.
        if (std::memcmp(values.data(), values.data() + 1, values.size_bytes() - sizeof(float)) == 0) {
            has_bad_value = !(std::abs(values[0]) <= 1e9f);
            return;
        }
        for (const float v : values) {
            has_bad_value = has_bad_value || !(std::abs(v) <= 1e9f);
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    BlockRange() = default;
};

// The error that names the first invalid value of a block whose first voxel is `at`.
ModelError bad_value(std::string_view who, const VoxelLattice& lattice, const std::array<int, 3>& at,
                     std::span<const float, VoxelGrid::kept_values> values) {
    const auto bad = std::ranges::find_if(values, [](float v) { return !(std::abs(v) <= 1e9f); });
    const auto i = static_cast<int>(bad - values.begin());
    constexpr int kept = VoxelGrid::kept_side;
    const std::array<int, 3> within{i % kept, i / kept % kept, i / kept / kept};
    std::array<int, 3> voxel;
    // Values beyond the border are copies of the border's.
    for (std::size_t a = 0; a < 3; ++a) voxel[a] = std::clamp(at[a] - 1 + within[a], 0, lattice.size[a] - 1);
    return ModelError(fmt::format("{}: the value at the voxel ({}, {}, {}) is too large, or not a number", who,
                                  voxel[0], voxel[1], voxel[2]));
}

// A grid with its header and an empty directory.
VoxelGrid empty_grid(std::string_view who, const VoxelLattice& lattice) {
    check(who, lattice);
    VoxelGrid grid{lattice, head_of(lattice)};
    // A directory takes at most 180 MB.
    constexpr std::size_t most_blocks = VoxelGrid::max_values / 8;
    const std::size_t count = Blocks(lattice.size).count();
    if (count > most_blocks) throw too_many_blocks(who, lattice.size, count, most_blocks);
    grid.table.resize(voxels::head + voxels::entry * count);
    return grid;
}

// Writes a block's directory entry. Returns whether its values are kept.
bool enter(const BlockRange& range, std::size_t kept, float* entry) {
    entry[0] = range.low < range.high ? static_cast<float>(kept) : -1.f;
    entry[1] = range.low;
    entry[2] = range.high;
    return range.low < range.high;
}

// Shaders fetch values even for blocks where they ignore them, so at least one block must exist.
void keep_some_block(std::vector<float>& table, std::size_t kept) {
    if (kept == 0) table.insert(table.end(), VoxelGrid::kept_values, table[voxels::head + 1]);
}

}  // namespace

VoxelGrid VoxelGrid::make(std::string_view who, const VoxelLattice& lattice, const Fill& fill) {
    VoxelGrid grid = empty_grid(who, lattice);
    std::array<float, kept_values> values;
    std::size_t kept = 0;
    const Blocks blocks(lattice.size);
    for (std::size_t i = 0; i < blocks.count(); ++i) {
        const std::array<int, 3> at = blocks.first_voxel(i);
        fill({at[0] - 1, at[1] - 1, at[2] - 1}, values);
        const BlockRange range(values);
        if (range.has_bad_value) throw bad_value(who, lattice, at, values);
        const bool is_kept = enter(range, kept, &grid.table[voxels::head + voxels::entry * i]);
        if (!is_kept) continue;
        ++kept;
        if (kept * kept_values > max_values) throw too_many_values(who);
        grid.table.insert(grid.table.end(), values.begin(), values.end());
    }
    keep_some_block(grid.table, kept);
    return grid;
}

// Examines blocks on all threads, then numbers them in order, then copies them on all threads.
VoxelGrid VoxelGrid::of_values(std::string_view who, const VoxelLattice& lattice, std::span<const float> values) {
    VoxelGrid grid = empty_grid(who, lattice);
    const std::array<int, 3> size = lattice.size;
    const Blocks blocks(size);
    // Copies the values of a block and its surroundings, from the voxel before its first one along each axis.
    const auto copy_about = [&](const std::array<int, 3>& at, std::span<float, kept_values> to) {
        const auto inside = [&](std::size_t axis, int i) {
            return static_cast<std::size_t>(std::clamp(at[axis] - 1 + i, 0, size[axis] - 1));
        };
        float* next = to.data();
        for (int z = 0; z < kept_side; ++z)
            for (int y = 0; y < kept_side; ++y) {
                const float* row = values.data() + (inside(2, z) * static_cast<std::size_t>(size[1]) + inside(1, y)) *
                                                       static_cast<std::size_t>(size[0]);
                for (int x = 0; x < kept_side; ++x) *next++ = row[inside(0, x)];
            }
    };
    std::vector<BlockRange> ranges(blocks.count());
    tbb::parallel_for(std::size_t{0}, ranges.size(), [&](std::size_t i) {
        std::array<float, kept_values> about;
        copy_about(blocks.first_voxel(i), about);
        ranges[i] = BlockRange(about);
    });
    std::vector<std::size_t> kept;  // the blocks whose values are kept
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (ranges[i].has_bad_value) {
            std::array<float, kept_values> about;
            copy_about(blocks.first_voxel(i), about);
            throw bad_value(who, lattice, blocks.first_voxel(i), about);
        }
        if (enter(ranges[i], kept.size(), &grid.table[voxels::head + voxels::entry * i])) kept.push_back(i);
    }
    if (kept.size() * kept_values > max_values) throw too_many_values(who);
    const std::size_t begin = grid.table.size();
    grid.table.resize(begin + kept.size() * kept_values);
    tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t i) {
        copy_about(blocks.first_voxel(kept[i]),
                   std::span<float, kept_values>(grid.table.data() + begin + i * kept_values, kept_values));
    });
    keep_some_block(grid.table, kept.size());
    return grid;
}

void VoxelGrid::divide_by(double by) {
    const Table at(table.data());
    const auto directory = static_cast<std::size_t>(at.directory - table.data());
    const auto values = static_cast<std::size_t>(at.values - table.data());
    const auto divide = [&](float& v) { v = static_cast<float>(static_cast<double>(v) / by); };
    for (std::size_t i = directory; i < values; i += voxels::entry)
        for (const std::size_t k : {i + 1, i + 2}) divide(table[k]);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(values, table.size(), 1 << 14), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) divide(table[i]);
    });
    divided_by *= by;
}

float VoxelGrid::greatest() const {
    const Table at(table.data());
    const std::size_t count = Blocks(lattice.size).count();
    float greatest = at.directory[2];
    for (std::size_t block = 1; block < count; ++block)
        greatest = std::max(greatest, at.directory[voxels::entry * block + voxels::greatest_of_block]);
    return greatest;
}

void VoxelGrid::move_first_to(const glm::dvec3& there) {
    lattice.first = there;
    for (glm::length_t i = 0; i < 3; ++i)
        table[voxels::first + static_cast<std::size_t>(i)] = static_cast<float>(there[i]);
}

Bounds VoxelGrid::blocks_below(float level) const {
    const Table at(table.data());
    const Blocks blocks(lattice.size);
    std::array<int, 3> low = lattice.size, high{-1, -1, -1};
    for (std::size_t block = 0; block < blocks.count(); ++block) {
        if (at.directory[voxels::entry * block + voxels::least_of_block] > level) continue;
        const std::array<int, 3> first = blocks.first_voxel(block);
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], first[i]);
            high[i] = std::max(high[i], first[i] + VoxelGrid::block_side - 1);
        }
    }
    if (high[0] < 0) return {};
    // In voxels: the range of influence of a spline, plus a little for rounding coordinates to floats.
    constexpr double influence = 1.5 + 0.001;
    Bounds box;
    for (glm::length_t i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        box.low[i] = static_cast<float>(lattice.first[i] + (low[k] - influence) * lattice.spacing[i]);
        box.high[i] = static_cast<float>(lattice.first[i] + (high[k] + influence) * lattice.spacing[i]);
    }
    return intersect(box, extent());
}

Bounds VoxelGrid::extent() const {
    Bounds box;
    for (glm::length_t i = 0; i < 3; ++i) {
        const double last = lattice.size[static_cast<std::size_t>(i)] - 0.5;
        box.low[i] = static_cast<float>(lattice.first[i] - 0.5 * lattice.spacing[i]);
        box.high[i] = static_cast<float>(lattice.first[i] + last * lattice.spacing[i]);
    }
    return box;
}

}  // namespace phasetree
