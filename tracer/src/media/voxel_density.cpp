#include "media/voxel_density.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>
#include <utility>

namespace phasetree::tracer {

namespace {

float greatest_of(const VoxelGrid& grid) {
    const voxels::Table table(grid.table.data());
    float greatest = 0.0f;
    for (const float* entry = table.directory; entry != table.values; entry += voxels::entry)
        greatest = std::max(greatest, entry[2]);
    return greatest;
}

}  // namespace

VoxelDensity::VoxelDensity(VoxelGrid grid, const VoxelPlacement& placement) : greatest_(greatest_of(grid)) {
    if (greatest_ > 0.0f) grid.divide_by(static_cast<double>(greatest_));
    // Near the grid's own origin floats resolve what they do not where a file may have it.
    const glm::dvec3 by = placement.linear * grid.lattice.first + placement.by;
    grid.lattice.first = glm::dvec3(0);
    for (std::size_t i = 0; i < 3; ++i) grid.table[voxels::first + i] = 0.0f;
    box_ = grid.extent();
    const glm::dmat3 back = glm::inverse(placement.linear);
    linear_ = glm::mat3(back);
    by_ = glm::vec3(back * -by);
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 at;
        for (int i = 0; i < 3; ++i) at[i] = static_cast<double>((corner >> i & 1) != 0 ? box_.high[i] : box_.low[i]);
        const glm::vec3 p(placement.linear * at + by);
        bounds_ = unite(bounds_, {p, p});
    }
    check_resolution(placement, by, grid.lattice.spacing);
    grid_ = std::make_shared<const VoxelGrid>(std::move(grid));
}

// That coordinates in the scene are a hundred times finer than voxels, and all numbers good floats.
void VoxelDensity::check_resolution(const VoxelPlacement& placement, const glm::dvec3& by,
                                    const glm::dvec3& spacing) const {
    constexpr double finest = 1e2 * 0x1p-24, least = 1e-30, most = 1e30;
    for (int i = 0; i < 3; ++i) {
        const double voxel = glm::length(placement.linear[i]) * spacing[i];
        const double farthest =
            std::max(std::abs(static_cast<double>(bounds_.low[i])), std::abs(static_cast<double>(bounds_.high[i])));
        const bool is_good = voxel > least && voxel < most && std::abs(by[i]) < most && voxel > finest * farthest &&
                             std::isfinite(by_[i]) && std::abs(by_[i]) < static_cast<float>(most);
        if (!is_good)
            throw std::invalid_argument("its voxels are too small for where they are, or too large or far away");
    }
}

BatchOfFloats VoxelDensity::at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const {
    const float* const data = grid_->table.data();
    BatchOfFloats density;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const glm::vec3 p = to_grid({x[i], y[i], z[i]});
        const bool is_inside =
            glm::all(glm::greaterThanEqual(p, box_.low)) && glm::all(glm::lessThanEqual(p, box_.high));
        density[i] = is_inside ? voxels::linear_at(data, Vec3<float>{p.x, p.y, p.z}) : 0.0f;
    }
    return density;
}

VoxelDensity::Stretches::Stretches(const VoxelDensity& density, const Way& way) {
    const float* const data = density.grid_->table.data();
    const Way in_grid{density.to_grid(way.origin), density.linear_ * way.direction, way.length};
    const auto [from, to] = part_within(density.box_, in_grid);
    if (!(from < to)) return;
    from_ = from;
    to_ = to;
    const glm::vec3 enters = in_grid.origin + from * in_grid.direction;
    const voxels::Table table(data);
    directory_ = table.directory;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        const float per_length = data[voxels::inverse_spacing + axis] / VoxelGrid::block_side;
        start_[i] = (enters[i] - data[voxels::first + axis]) * per_length;
        step_[i] = in_grid.direction[i] * per_length;
        blocks_[i] = table.blocks[axis];
        block_[i] = std::clamp(static_cast<int>(std::floor(start_[i])), 0, blocks_[i] - 1);
    }
}

std::optional<DensityStretch> VoxelDensity::Stretches::next() {
    const float length = to_ - from_;
    while (at_ < length) {
        // The face by which the way leaves the block. Distances are those from where the way enters the grid. The
        // outermost blocks reach to the grid's own faces, where the way ends.
        float leaves = length;
        std::optional<int> axis;
        for (int i = 0; i < 3; ++i) {
            const bool is_last = step_[i] > 0.0f ? block_[i] == blocks_[i] - 1 : block_[i] == 0;
            if (step_[i] == 0.0f || is_last) continue;
            const auto face = static_cast<float>(step_[i] > 0.0f ? block_[i] + 1 : block_[i]);
            const float distance = (face - start_[i]) / step_[i];
            if (distance < leaves) {
                leaves = distance;
                axis = i;
            }
        }
        const int number = block_.x + blocks_.x * (block_.y + blocks_.y * block_.z);
        const float greatest = directory_[voxels::entry * static_cast<std::size_t>(number) + 2];
        leaves = std::max(leaves, at_);
        const DensityStretch stretch{from_ + at_, std::min(from_ + leaves, to_), greatest};
        at_ = leaves;
        if (axis) block_[*axis] += step_[*axis] > 0.0f ? 1 : -1;
        if (greatest > 0.0f && stretch.from < stretch.to) return stretch;
    }
    return std::nullopt;
}

}  // namespace phasetree::tracer
