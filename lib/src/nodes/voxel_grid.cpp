#include "phasetree/nodes/fields/voxel_grid.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "phasetree/model/handle.hpp"

namespace phasetree {

using voxels::Table;

namespace {

constexpr int side = VoxelGrid::block_side;

std::array<int, 3> blocks_of(const std::array<int, 3>& size) {
    std::array<int, 3> blocks;
    for (std::size_t i = 0; i < 3; ++i) blocks[i] = (size[i] + side - 1) / side;
    return blocks;
}

std::vector<float> head_of(const VoxelLattice& lattice) {
    std::vector<float> head;
    for (const int n : lattice.size) head.push_back(static_cast<float>(n));
    for (const int n : blocks_of(lattice.size)) head.push_back(static_cast<float>(n));
    for (int i = 0; i < 3; ++i) head.push_back(static_cast<float>(lattice.first[i]));
    for (int i = 0; i < 3; ++i) head.push_back(static_cast<float>(1 / lattice.spacing[i]));
    return head;
}

std::size_t count_of_blocks(const std::array<int, 3>& size) {
    std::size_t count = 1;
    for (const int n : blocks_of(size)) count *= static_cast<std::size_t>(n);
    return count;
}

// The first voxel of a block, of which x varies fastest.
std::array<int, 3> first_voxel_of(std::size_t block, const std::array<int, 3>& size) {
    std::array<int, 3> first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto blocks = static_cast<std::size_t>(blocks_of(size)[axis]);
        first[axis] = static_cast<int>(block % blocks) * side;
        block /= blocks;
    }
    return first;
}

// Calls f(first voxel) for each block.
template <class F>
void for_each_block(const std::array<int, 3>& size, F&& f) {
    for (std::size_t block = 0; block < count_of_blocks(size); ++block) f(first_voxel_of(block, size));
}

// The largest f(values) of all blocks that are kept, but at least 0. In other blocks, and next to them, nothing
// changes.
template <class F>
double largest_at_kept_blocks(const std::vector<float>& table, F&& f) {
    const float* values = Table(table.data()).values;
    const auto count = static_cast<std::size_t>(table.data() + table.size() - values) / VoxelGrid::kept_values;
    constexpr std::size_t at_once = 64;
    std::vector<double> largest((count + at_once - 1) / at_once, 0.0);
    tbb::parallel_for(std::size_t{0}, largest.size(), [&](std::size_t part) {
        for (std::size_t i = part * at_once; i < std::min((part + 1) * at_once, count); ++i)
            largest[part] = std::max(largest[part], f(values + i * VoxelGrid::kept_values));
    });
    return largest.empty() ? 0.0 : *std::ranges::max_element(largest);
}

// The same of f(values about a voxel); the neighbours along x, y and z are 1, 10 and 100 places before and behind.
// Voxels behind the grid's last ones are copies of them, at which nothing is steeper than at those.
template <class F>
double largest_at_kept_voxels(const std::vector<float>& table, F&& f) {
    return largest_at_kept_blocks(table, [&](const float* block) {
        double largest = 0;
        for (int z = 1; z <= side; ++z)
            for (int y = 1; y <= side; ++y)
                for (int x = 1; x <= side; ++x) largest = std::max(largest, f(block + x + 10 * y + 100 * z));
        return largest;
    });
}

double squared(double x) {
    return x * x;
}

}  // namespace

Table::Table(const float* data) : directory(data + voxels::head) {
    std::size_t all = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        size[i] = static_cast<int>(data[voxels::size + i]);
        blocks[i] = static_cast<int>(data[voxels::blocks + i]);
        all *= static_cast<std::size_t>(blocks[i]);
    }
    values = directory + voxels::entry * all;
}

const float* Table::block_of(int x, int y, int z) const {
    const auto of = [](int a, int count, int b) {
        return static_cast<std::size_t>(a) * static_cast<std::size_t>(count) + static_cast<std::size_t>(b);
    };
    const std::size_t row = of(z >> 3, blocks[1], y >> 3);
    return directory + voxels::entry * (row * static_cast<std::size_t>(blocks[0]) + static_cast<std::size_t>(x >> 3));
}

float Table::operator()(int x, int y, int z) const {
    const float* block = block_of(x, y, z);
    if (block[0] < 0) return block[1];
    const int within = (x & 7) + 1 + 10 * ((y & 7) + 1) + 100 * ((z & 7) + 1);
    return values[VoxelGrid::kept_values * static_cast<std::size_t>(block[0]) + static_cast<std::size_t>(within)];
}

namespace {

void check(std::string_view who, const VoxelLattice& lattice) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (lattice.size[i] < 1) throw ModelError(fmt::format("{}: the grid is empty", who));
        if (lattice.size[i] > VoxelGrid::most_along_axis)
            throw ModelError(fmt::format("{}: the grid has {} voxels along an axis; at most {} can be", who,
                                         lattice.size[i], VoxelGrid::most_along_axis));
        const auto axis = static_cast<glm::length_t>(i);
        if (!(lattice.spacing[axis] >= 1e-9 && lattice.spacing[axis] <= 1e6) || !(std::abs(lattice.first[axis]) <= 1e9))
            throw ModelError(fmt::format("{}: voxels must be 1e-9 to 1e6 m apart, at most 1e9 m from the origin", who));
    }
}

ModelError too_many_values(std::string_view who) {
    return ModelError(fmt::format("{}: the grid has more than {} values that differ from their neighbours", who,
                                  VoxelGrid::most_values));
}

// What the directory says of a block, and what is wrong with it.
struct BlockRange {
    float low = 0, high = 0;
    bool has_bad_value = false;  // too large, or no number

    explicit BlockRange(std::span<const float, VoxelGrid::kept_values> values) : low(values[0]), high(values[0]) {
        for (const float v : values) {
            has_bad_value = has_bad_value || !(std::abs(v) <= 1e9f);
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    BlockRange() = default;
};

// The error that names the first bad value of a block whose first voxel is `at`.
ModelError bad_value(std::string_view who, const VoxelLattice& lattice, const std::array<int, 3>& at,
                     std::span<const float, VoxelGrid::kept_values> values) {
    const auto bad = std::ranges::find_if(values, [](float v) { return !(std::abs(v) <= 1e9f); });
    const auto i = static_cast<int>(bad - values.begin());
    constexpr int kept = VoxelGrid::kept_side;
    const std::array<int, 3> within{i % kept, i / kept % kept, i / kept / kept};
    std::array<int, 3> voxel;
    // What is beyond the border is the border's.
    for (std::size_t a = 0; a < 3; ++a) voxel[a] = std::clamp(at[a] - 1 + within[a], 0, lattice.size[a] - 1);
    return ModelError(fmt::format("{}: the value at the voxel ({}, {}, {}) is too large, or no number", who, voxel[0],
                                  voxel[1], voxel[2]));
}

// A grid with its head and an empty directory.
VoxelGrid empty_grid(std::string_view who, const VoxelLattice& lattice) {
    check(who, lattice);
    VoxelGrid grid{lattice, head_of(lattice)};
    // A directory takes 180 MB at most.
    constexpr std::size_t most_blocks = VoxelGrid::most_values / 8;
    const std::size_t count = count_of_blocks(lattice.size);
    if (count > most_blocks) throw too_many_values(who);
    grid.table.resize(voxels::head + voxels::entry * count);
    return grid;
}

// Enters a block, and returns whether its values are kept.
bool enter(const BlockRange& range, std::size_t kept, float* entry) {
    entry[0] = range.low < range.high ? static_cast<float>(kept) : -1.f;
    entry[1] = range.low;
    entry[2] = range.high;
    return range.low < range.high;
}

// Shaders look up the values of some block also where they do not use them.
void keep_some_block(std::vector<float>& table, std::size_t kept) {
    if (kept == 0) table.insert(table.end(), VoxelGrid::kept_values, table[voxels::head + 1]);
}

}  // namespace

VoxelGrid VoxelGrid::make(std::string_view who, const VoxelLattice& lattice, const Fill& fill) {
    VoxelGrid grid = empty_grid(who, lattice);
    std::array<float, kept_values> values;
    std::size_t entry = voxels::head, kept = 0;
    for_each_block(lattice.size, [&](const std::array<int, 3>& at) {
        fill({at[0] - 1, at[1] - 1, at[2] - 1}, values);
        const BlockRange range(values);
        if (range.has_bad_value) throw bad_value(who, lattice, at, values);
        const bool is_kept = enter(range, kept, &grid.table[entry]);
        entry += voxels::entry;
        if (!is_kept) return;
        ++kept;
        if (kept * kept_values > most_values) throw too_many_values(who);
        grid.table.insert(grid.table.end(), values.begin(), values.end());
    });
    keep_some_block(grid.table, kept);
    return grid;
}

// Blocks are looked at on all threads, then numbered in their order, then copied on all threads.
VoxelGrid VoxelGrid::of_values(std::string_view who, const VoxelLattice& lattice, std::span<const float> values) {
    VoxelGrid grid = empty_grid(who, lattice);
    const std::array<int, 3> size = lattice.size;
    // The values about a block, from the voxel before its first along each axis.
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
    std::vector<BlockRange> ranges(count_of_blocks(size));
    tbb::parallel_for(std::size_t{0}, ranges.size(), [&](std::size_t i) {
        std::array<float, kept_values> about;
        copy_about(first_voxel_of(i, size), about);
        ranges[i] = BlockRange(about);
    });
    std::vector<std::size_t> blocks;  // those that are kept
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (ranges[i].has_bad_value) {
            std::array<float, kept_values> about;
            copy_about(first_voxel_of(i, size), about);
            throw bad_value(who, lattice, first_voxel_of(i, size), about);
        }
        if (enter(ranges[i], blocks.size(), &grid.table[voxels::head + voxels::entry * i])) blocks.push_back(i);
    }
    if (blocks.size() * kept_values > most_values) throw too_many_values(who);
    const std::size_t begin = grid.table.size();
    grid.table.resize(begin + blocks.size() * kept_values);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        copy_about(first_voxel_of(blocks[i], size),
                   std::span<float, kept_values>(grid.table.data() + begin + i * kept_values, kept_values));
    });
    keep_some_block(grid.table, blocks.size());
    return grid;
}

// In a cell between eight voxels the derivative along x is linear along y and along z and does not depend on x. So the
// square of the slope is convex along each axis, and largest at one of the eight voxels, where the derivatives are
// the differences to the neighbours.
double VoxelGrid::steepest_linear() const {
    const double steepest = largest_at_kept_voxels(table, [&](const float* v) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int step = std::array{1, 10, 100}[axis];
            const float most = std::max(std::abs(v[step] - v[0]), std::abs(v[-step] - v[0]));
            sum += squared(static_cast<double>(most) / lattice.spacing[static_cast<glm::length_t>(axis)]);
        }
        return sum;
    });
    return std::sqrt(steepest) * (1 + 1e-6);
}

namespace {

// By value, so that loops over them become vector instructions.
float larger(float a, float b) {
    return a < b ? b : a;
}

// For all voxels of a block at once, the largest of the values before, at and behind along an axis.
void larger_of_three(std::array<float, VoxelGrid::kept_values>& values, std::size_t stride) {
    const std::array<float, VoxelGrid::kept_values> from = values;
    for (std::size_t i = stride; i < from.size() - stride; ++i)
        values[i] = larger(from[i], larger(from[i - stride], from[i + stride]));
}

}  // namespace

// The derivative along x is an average of the differences along x between the 27 voxels, so it is at most the largest
// of them. The bound on the slope takes the largest along each axis, which need not be at one place. They are found for
// all voxels of a block at once, along one axis after the other; what these loops compute for voxels at the block's
// border wraps around it, and is not used. The sum of squares is taken in floats first, which lose less than a part in
// 10⁵, and in doubles where it may be the largest.
double VoxelGrid::steepest_spline() const {
    using Block = std::array<float, kept_values>;
    const glm::vec3 inverse(1.0 / lattice.spacing);
    const double steepest = largest_at_kept_blocks(table, [&](const float* v) {
        std::array<Block, 3> most;
        Block rough{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::array<std::size_t, 3> stride{1, 10, 100};
            const std::size_t step = stride[axis];
            Block& along = most[axis];
            along.fill(0.f);
            for (std::size_t i = step; i < kept_values - step; ++i)
                along[i] = larger(std::abs(v[i + step] - v[i]), std::abs(v[i] - v[i - step]));
            larger_of_three(along, stride[(axis + 1) % 3]);
            larger_of_three(along, stride[(axis + 2) % 3]);
            const float per_length = inverse[static_cast<glm::length_t>(axis)];
            for (std::size_t i = 0; i < kept_values; ++i) rough[i] += along[i] * per_length * (along[i] * per_length);
        }
        double largest = 0;
        float least = 0;  // of the rough sums of squares that may be larger
        for (std::size_t z = 1; z <= 8; ++z)
            for (std::size_t y = 1; y <= 8; ++y)
                for (std::size_t x = 1; x <= 8; ++x) {
                    const std::size_t i = x + 10 * y + 100 * z;
                    if (rough[i] < least) continue;
                    double sum = 0;
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        sum += squared(static_cast<double>(most[axis][i]) /
                                       lattice.spacing[static_cast<glm::length_t>(axis)]);
                    largest = std::max(largest, sum);
                    least = static_cast<float>(largest) * (1 - 1e-5f);
                }
        return largest;
    });
    return std::sqrt(steepest) * (1 + 1e-6);
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

Bounds VoxelGrid::blocks_below(float level) const {
    const Table at(table.data());
    std::array<int, 3> low = lattice.size, high{-1, -1, -1};
    for_each_block(lattice.size, [&](const std::array<int, 3>& first) {
        if (at.block_of(first[0], first[1], first[2])[1] > level) return;
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], first[i]);
            high[i] = std::max(high[i], first[i] + side - 1);
        }
    });
    if (high[0] < 0) return {};
    // In voxels: as far as a spline has influence, and a little for the rounding of coordinates to floats.
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

namespace voxels {

namespace {

// Where in the table the value of a voxel is, and those of its neighbours 1, 10 and 100 places before and behind it; a
// null pointer if the block is not kept because all of these are the value `only`. It reads the table as Table does,
// but faster, since it is called for each point.
struct Around {
    const float* values;
    float only;
};
[[gnu::always_inline]] inline Around around(const float* data, const std::array<int, 3>& voxel) {
    const auto blocks = [&](std::size_t axis) { return static_cast<std::size_t>(data[voxels::blocks + axis]); };
    const auto of = [&](std::size_t axis) { return static_cast<std::size_t>(voxel[axis] >> 3); };
    const std::size_t nx = blocks(0), ny = blocks(1), nz = blocks(2);
    const float* directory = data + head;
    const float* block = directory + entry * (of(0) + nx * (of(1) + ny * of(2)));
    if (block[0] < 0) return {nullptr, block[1]};
    const int within = (voxel[0] & 7) + 1 + 10 * ((voxel[1] & 7) + 1) + 100 * ((voxel[2] & 7) + 1);
    return {directory + entry * (nx * ny * nz) + VoxelGrid::kept_values * static_cast<std::size_t>(block[0]) + within,
            0};
}

}  // namespace

void gather_eight(const float* data, const Vec3<float>& p, float* to, std::size_t stride) {
    const std::array<float, 3> u = places(data, p, 0.f);
    std::array<int, 3> voxel;
    for (std::size_t a = 0; a < 3; ++a) {
        // The place is not negative, so this is its floor.
        voxel[a] = std::max(std::min(static_cast<int>(u[a]), static_cast<int>(data[size + a]) - 2), 0);
        to[a * stride] = static_cast<float>(voxel[a]);
    }
    to += 3 * stride;
    const Around at = around(data, voxel);
    if (!at.values) {
        for (std::size_t i = 0; i < 8; ++i) to[i * stride] = at.only;
        return;
    }
    for (const int offset : {0, 1, 10, 11, 100, 101, 110, 111}) {
        *to = at.values[offset];
        to += stride;
    }
}

void gather_twenty_seven(const float* data, const Vec3<float>& p, float* to, std::size_t stride) {
    const std::array<float, 3> u = places(data, p, 0.5f);
    std::array<int, 3> voxel;
    for (std::size_t a = 0; a < 3; ++a) {
        voxel[a] = std::min(static_cast<int>(u[a] + 0.5f), static_cast<int>(data[size + a]) - 1);
        to[a * stride] = static_cast<float>(voxel[a]);
    }
    to += 3 * stride;
    const Around at = around(data, voxel);
    if (!at.values) {
        for (std::size_t i = 0; i < 27; ++i) to[i * stride] = at.only;
        return;
    }
    for (int k = -100; k <= 100; k += 100)
        for (int j = -10; j <= 10; j += 10) {
            const float* row = at.values + (j + k);
            to[0] = row[-1];
            to[stride] = row[0];
            to[2 * stride] = row[1];
            to += 3 * stride;
        }
}

const float* for_shader(std::string_view who, const float* data) {
    const Table at(data);
    std::size_t kept = 0;
    for (const float* block = at.directory; block < at.values; block += entry) kept += block[0] >= 0;
    constexpr std::size_t most = 1 << 21;
    // Numbers of places are floats there.
    if (static_cast<std::size_t>(at.values - at.directory) > most)
        throw ModelError(fmt::format("{}: the grid has too many voxels for a shader", who));
    if (kept * VoxelGrid::kept_values > most)
        throw ModelError(fmt::format("{}: a shader carries at most {} values of a grid, but this has {}", who, most,
                                     kept * VoxelGrid::kept_values));
    return data;
}

}  // namespace voxels
}  // namespace phasetree
