#include "phasetree/nodes/fields/voxel_grid.hpp"

#include <fmt/format.h>

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

// Calls f(first voxel) for each block, x fastest.
template <class F>
void for_each_block(const std::array<int, 3>& size, F&& f) {
    for (int z = 0; z < size[2]; z += side)
        for (int y = 0; y < size[1]; y += side)
            for (int x = 0; x < size[0]; x += side) f(std::array{x, y, z});
}

// Whether a block and those that touch it hold the same value alone, so that nothing changes in it.
bool is_flat(const Table& table, const std::array<int, 3>& at) {
    const float* own = table.block_of(at[0], at[1], at[2]);
    if (own[0] >= 0) return false;
    for (int k = -side; k <= side; k += side)
        for (int j = -side; j <= side; j += side)
            for (int i = -side; i <= side; i += side) {
                const std::array to{at[0] + i, at[1] + j, at[2] + k};
                bool is_there = true;
                for (std::size_t a = 0; a < 3; ++a) is_there = is_there && to[a] >= 0 && to[a] < table.size[a];
                if (!is_there) continue;
                const float* other = table.block_of(to[0], to[1], to[2]);
                if (other[0] >= 0 || other[1] != own[1]) return false;
            }
    return true;
}

// Calls f(x, y, z) for the voxels near which values change.
template <class F>
void for_each_voxel_of_change(const Table& table, F&& f) {
    for_each_block(table.size, [&](const std::array<int, 3>& at) {
        if (is_flat(table, at)) return;
        std::array<int, 3> end;
        for (std::size_t i = 0; i < 3; ++i) end[i] = std::min(at[i] + side, table.size[i]);
        for (int z = at[2]; z < end[2]; ++z)
            for (int y = at[1]; y < end[1]; ++y)
                for (int x = at[0]; x < end[0]; ++x) f(x, y, z);
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
    const auto within = static_cast<std::size_t>((x & 7) + 8 * ((y & 7) + 8 * (z & 7)));
    return values[VoxelGrid::block_values * static_cast<std::size_t>(block[0]) + within];
}

VoxelGrid VoxelGrid::make(std::string_view who, const VoxelLattice& lattice, const Fill& fill) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (lattice.size[i] < 1) throw ModelError(fmt::format("{}: the grid is empty", who));
        if (lattice.size[i] > most_along_axis)
            throw ModelError(fmt::format("{}: the grid has {} voxels along an axis; at most {} can be", who,
                                         lattice.size[i], most_along_axis));
        const auto axis = static_cast<glm::length_t>(i);
        if (!(lattice.spacing[axis] >= 1e-9 && lattice.spacing[axis] <= 1e6) || !(std::abs(lattice.first[axis]) <= 1e9))
            throw ModelError(fmt::format("{}: voxels must be 1e-9 to 1e6 m apart, at most 1e9 m from the origin", who));
    }
    VoxelGrid grid{lattice, head_of(lattice)};
    const std::array<int, 3> blocks = blocks_of(lattice.size);
    const std::size_t count =
        static_cast<std::size_t>(blocks[0]) * static_cast<std::size_t>(blocks[1]) * static_cast<std::size_t>(blocks[2]);
    const auto too_many = [&] {
        return ModelError(
            fmt::format("{}: the grid has more than {} values that differ from their neighbours", who, most_values));
    };
    if (count > most_values / 8) throw too_many();
    grid.table.resize(voxels::head + voxels::entry * count);
    std::array<float, block_values> values;
    std::size_t entry = voxels::head, kept = 0;
    for_each_block(lattice.size, [&](const std::array<int, 3>& at) {
        fill(at, values);
        float low = values[0], high = values[0];
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!(std::abs(values[i]) <= 1e9f)) {
                const auto n = static_cast<int>(i);
                throw ModelError(fmt::format("{}: the value at the voxel ({}, {}, {}) is too large, or no number", who,
                                             at[0] + n % side, at[1] + n / side % side, at[2] + n / side / side));
            }
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
        }
        grid.table[entry] = low < high ? static_cast<float>(kept) : -1.f;
        grid.table[entry + 1] = low;
        grid.table[entry + 2] = high;
        entry += voxels::entry;
        if (!(low < high)) return;
        ++kept;
        if (kept * block_values > most_values) throw too_many();
        grid.table.insert(grid.table.end(), values.begin(), values.end());
    });
    // Shaders look up the values of some block also where they do not use them.
    if (kept == 0) grid.table.insert(grid.table.end(), block_values, grid.table[voxels::head + 1]);
    return grid;
}

// In a cell between eight voxels the derivative along x is linear along y and along z and does not depend on x. So the
// square of the slope is convex along each axis, and largest at one of the eight voxels, where the derivatives are
// the differences to the neighbours.
double VoxelGrid::steepest_linear() const {
    const Table at(table.data());
    double steepest = 0;
    for_each_voxel_of_change(at, [&](int x, int y, int z) {
        const std::array<int, 3> here{x, y, z};
        const float own = at(x, y, z);
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double most = 0;
            for (const int step : {-1, 1}) {
                std::array<int, 3> to = here;
                to[axis] += step;
                if (to[axis] < 0 || to[axis] >= at.size[axis]) continue;
                most =
                    std::max(most, std::abs(static_cast<double>(at(to[0], to[1], to[2])) - static_cast<double>(own)));
            }
            sum += squared(most / lattice.spacing[static_cast<glm::length_t>(axis)]);
        }
        steepest = std::max(steepest, sum);
    });
    return std::sqrt(steepest);
}

// The derivative along x is an average of the differences along x between the 27 voxels.
double VoxelGrid::steepest_spline() const {
    const Table at(table.data());
    double steepest = 0;
    for_each_voxel_of_change(at, [&](int x, int y, int z) {
        std::array<std::array<int, 3>, 3> index;
        const std::array<int, 3> here{x, y, z};
        for (std::size_t a = 0; a < 3; ++a)
            index[a] = {std::max(here[a] - 1, 0), here[a], std::min(here[a] + 1, at.size[a] - 1)};
        std::array<float, 27> v;
        for (std::size_t i = 0; i < 27; ++i) v[i] = at(index[0][i % 3], index[1][i / 3 % 3], index[2][i / 9]);
        double sum = 0;
        constexpr std::array<std::size_t, 3> stride{1, 3, 9};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float most = 0;
            for (std::size_t i = 0; i < 27; ++i)
                if (i / stride[axis] % 3 < 2) most = std::max(most, std::abs(v[i + stride[axis]] - v[i]));
            sum += squared(static_cast<double>(most) / lattice.spacing[static_cast<glm::length_t>(axis)]);
        }
        steepest = std::max(steepest, sum);
    });
    return std::sqrt(steepest);
}

void VoxelGrid::divide_by(double by) {
    const Table at(table.data());
    const auto directory = static_cast<std::size_t>(at.directory - table.data());
    const auto values = static_cast<std::size_t>(at.values - table.data());
    const auto divided = [&](float v) { return static_cast<float>(static_cast<double>(v) / by); };
    for (std::size_t i = directory; i < values; i += voxels::entry)
        for (const std::size_t k : {i + 1, i + 2}) table[k] = divided(table[k]);
    for (std::size_t i = values; i < table.size(); ++i) table[i] = divided(table[i]);
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
    Bounds box;
    for (glm::length_t i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        box.low[i] = static_cast<float>(lattice.first[i] + (low[k] - 1.501) * lattice.spacing[i]);
        box.high[i] = static_cast<float>(lattice.first[i] + (high[k] + 1.501) * lattice.spacing[i]);
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

// Writes the values of count³ voxels. Mostly they are in one block.
template <std::size_t count>
void gather(const Table& at, const std::array<std::array<int, count>, 3>& index, float* to, std::size_t stride) {
    const auto [x, y, z] = index;
    const bool is_one_block =
        x[0] >> 3 == x[count - 1] >> 3 && y[0] >> 3 == y[count - 1] >> 3 && z[0] >> 3 == z[count - 1] >> 3;
    if (!is_one_block) {
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t j = 0; j < count; ++j)
                for (std::size_t i = 0; i < count; ++i, to += stride) *to = at(x[i], y[j], z[k]);
        return;
    }
    const float* block = at.block_of(x[0], y[0], z[0]);
    if (block[0] < 0) {
        for (std::size_t i = 0; i < count * count * count; ++i, to += stride) *to = block[1];
        return;
    }
    const float* values = at.values + VoxelGrid::block_values * static_cast<std::size_t>(block[0]);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t j = 0; j < count; ++j) {
            const float* row = values + 8 * ((y[j] & 7) + 8 * (z[k] & 7));
            for (std::size_t i = 0; i < count; ++i, to += stride) *to = row[x[i] & 7];
        }
}

}  // namespace

void gather_eight(const float* data, const Vec3<float>& p, float* to, std::size_t stride) {
    const Table at(data);
    const std::array<float, 3> u = places(data, p, 0.f);
    std::array<std::array<int, 2>, 3> index;
    for (std::size_t a = 0; a < 3; ++a) {
        to[a * stride] = first_of_two(data, a, u[a]);
        const int i = static_cast<int>(to[a * stride]);
        index[a] = {i, std::min(i + 1, at.size[a] - 1)};
    }
    gather(at, index, to + 3 * stride, stride);
}

void gather_twenty_seven(const float* data, const Vec3<float>& p, float* to, std::size_t stride) {
    const Table at(data);
    const std::array<float, 3> u = places(data, p, 0.5f);
    std::array<std::array<int, 3>, 3> index;
    for (std::size_t a = 0; a < 3; ++a) {
        to[a * stride] = middle_of_three(data, a, u[a]);
        const int i = static_cast<int>(to[a * stride]);
        index[a] = {std::max(i - 1, 0), i, std::min(i + 1, at.size[a] - 1)};
    }
    gather(at, index, to + 3 * stride, stride);
}

const float* for_shader(std::string_view who, const float* data) {
    const Table at(data);
    std::size_t kept = 0;
    for (const float* block = at.directory; block < at.values; block += entry) kept += block[0] >= 0;
    constexpr std::size_t most = 1 << 21;
    // Numbers of places are floats there.
    if (static_cast<std::size_t>(at.values - at.directory) > most)
        throw ModelError(fmt::format("{}: the grid has too many voxels for a shader", who));
    if (kept * VoxelGrid::block_values > most)
        throw ModelError(fmt::format("{}: a shader carries at most {} values of a grid, but this has {}", who, most,
                                     kept * VoxelGrid::block_values));
    return data;
}

}  // namespace voxels
}  // namespace phasetree
