// Looks up the values of a grid's voxels in its table.
#include <fmt/format.h>

#include <algorithm>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::voxels {

Table::Table(const float* data) : directory(data + head) {
    std::size_t all = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        size[i] = static_cast<int>(data[voxels::size + i]);
        blocks[i] = static_cast<int>(data[voxels::blocks + i]);
        all *= static_cast<std::size_t>(blocks[i]);
    }
    values = directory + entry * all;
}

const float* Table::block_of(int x, int y, int z) const {
    const auto of = [](int a, int count, int b) {
        return static_cast<std::size_t>(a) * static_cast<std::size_t>(count) + static_cast<std::size_t>(b);
    };
    const std::size_t row = of(z >> 3, blocks[1], y >> 3);
    return directory + entry * (row * static_cast<std::size_t>(blocks[0]) + static_cast<std::size_t>(x >> 3));
}

float Table::operator()(int x, int y, int z) const {
    const float* block = block_of(x, y, z);
    if (block[0] < 0) return block[1];
    const int within = (x & 7) + 1 + 10 * ((y & 7) + 1) + 100 * ((z & 7) + 1);
    return values[VoxelGrid::kept_values * static_cast<std::size_t>(block[0]) + static_cast<std::size_t>(within)];
}

namespace {

// The location in the table of a voxel's value; its neighbours are 1, 10 and 100 floats before and after it. The
// pointer is null if the block is not stored because all of these equal `only`. It reads the table as Table does, but
// faster, because it is called for each point.
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
        // The coordinate is not negative, so truncation is its floor.
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
    // Shaders represent offsets into the table as floats.
    if (static_cast<std::size_t>(at.values - at.directory) > most)
        throw ModelError(fmt::format("{}: the grid has too many voxels for a shader", who));
    if (kept * VoxelGrid::kept_values > most)
        throw ModelError(fmt::format("{}: a shader can hold at most {} values of a grid, but this one has {}", who,
                                     most, kept * VoxelGrid::kept_values));
    return data;
}

}  // namespace phasetree::voxels
