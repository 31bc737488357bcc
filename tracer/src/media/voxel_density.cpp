#include "media/voxel_density.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>
#include <utility>

namespace phasetree::tracer {

VoxelDensity::VoxelDensity(VoxelGrid grid, const VoxelPlacement& placement) : greatest_number_(grid.greatest()) {
    if (greatest_number_ > 0.0f) grid.divide_by(static_cast<double>(greatest_number_));
    // The grid is moved such that its first voxel is at its own origin: far from the origin, floats would not resolve
    // voxels.
    const glm::dvec3 translation = placement.linear * grid.lattice.first + placement.translation;
    grid.move_first_to(glm::dvec3(0));
    box_ = grid.extent();
    const glm::dmat3 to_grid = glm::inverse(placement.linear);
    to_grid_ = glm::mat3(to_grid);
    to_grid_offset_ = glm::vec3(to_grid * -translation);
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 at;
        for (int i = 0; i < 3; ++i) at[i] = static_cast<double>((corner >> i & 1) != 0 ? box_.high[i] : box_.low[i]);
        const glm::vec3 p(placement.linear * at + translation);
        bounds_ = unite(bounds_, {p, p});
    }
    check_resolution(grid.lattice.spacing);
    grid_ = std::make_shared<const VoxelGrid>(std::move(grid));
}

// Throws unless the resolution of floats in the scene is finer than a hundredth of a voxel along each of its axes.
void VoxelDensity::check_resolution(const glm::dvec3& spacing) const {
    constexpr double float_step = 0x1p-24, share_of_voxel = 0.01, least = 1e-30;
    const glm::dvec3 farthest(glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high)));
    const glm::dmat3 to_grid(to_grid_);
    bool is_fine = bounds_.finite();
    for (int axis = 0; axis < 3; ++axis) {
        double step = 0;
        for (int i = 0; i < 3; ++i) step += std::abs(to_grid[i][axis]) * farthest[i] * float_step;
        is_fine =
            is_fine && step < share_of_voxel * spacing[axis] && static_cast<double>(bounds_.extent()[axis]) > least;
    }
    if (!is_fine) throw std::invalid_argument("its voxels are too small for their distance from the origin");
}

float VoxelDensity::at(const glm::vec3& p) const {
    const glm::vec3 q = in_grid(p);
    const bool is_inside = glm::all(glm::greaterThanEqual(q, box_.low)) && glm::all(glm::lessThanEqual(q, box_.high));
    return is_inside ? voxels::linear_at(grid_->table.data(), Vec3<float>{q.x, q.y, q.z}) : 0.0f;
}

BatchOfFloats VoxelDensity::at(const PointBatch& points, std::size_t count) const {
    BatchOfFloats density;
    for (std::size_t i = 0; i < count; ++i) density[i] = at(points[i]);
    return density;
}

VoxelDensity::Stretches::Stretches(const VoxelDensity& density, const Way& way) {
    const float* const data = density.grid_->table.data();
    // The direction does not have unit length there, so that distances remain those in the scene.
    const Way in_grid{density.in_grid(way.origin), density.to_grid_ * way.direction, way.length};
    const auto [from, to] = part_within(density.box_, in_grid);
    if (!(from < to)) return;
    from_ = from;
    to_ = to;
    const glm::vec3 enters = in_grid.origin + from * in_grid.direction;
    const voxels::Table table(data);
    directory_ = table.directory;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        const float blocks_per_length = data[voxels::inverse_spacing + axis] / VoxelGrid::block_side;
        start_[i] = enters[i] * blocks_per_length;
        step_[i] = in_grid.direction[i] * blocks_per_length;
        blocks_[i] = table.blocks[axis];
        block_[i] = std::clamp(static_cast<int>(std::floor(start_[i])), 0, blocks_[i] - 1);
    }
}

std::optional<DensityStretch> VoxelDensity::Stretches::next() {
    const float length = to_ - from_;
    while (at_ < length) {
        // The face through which the segment leaves the block. Distances are relative to where the segment enters the
        // grid. The outermost blocks extend to the grid's own faces, where the segment ends.
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
        const float bound = directory_[voxels::entry * static_cast<std::size_t>(number) + voxels::greatest_of_block];
        leaves = std::max(leaves, at_);
        const DensityStretch stretch{from_ + at_, std::min(from_ + leaves, to_), bound};
        at_ = leaves;
        if (axis) block_[*axis] += step_[*axis] > 0.0f ? 1 : -1;
        if (bound > 0.0f && stretch.from < stretch.to) return stretch;
    }
    return std::nullopt;
}

}  // namespace phasetree::tracer
