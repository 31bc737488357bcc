#include "nodes/voxels/label_depths.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace phasetree {

namespace {

// The margin, in voxels, by which the depth of a voxel's own phase exceeds that of any other. If blurring makes another
// phase deeper by some amount, the voxel's own phase leads by that amount afterwards, but at most by most_margin. That
// is enough for a wall of one voxel to stay about half a voxel thick, and keeps the slope, by which everything is
// divided, small. The least margin far exceeds the errors from rounding and all_the_same.
constexpr float least_margin = 0.02f, most_margin = 0.3f;
// Spline coefficients closer than this to the greatest or least depth are set to it, so that most blocks have a single
// value and take no memory. The error of the spline is then at most as large.
constexpr float all_the_same = 1e-4f;
// Blurred phases are needed twice. If they take more than this, a quarter of a gigabyte, they are computed twice.
constexpr std::size_t most_kept_bytes = std::size_t{1} << 28;

// Calls f(i) for each voxel.
template <class F>
void for_each_voxel(std::size_t count, const F& f) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 14), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) f(i);
    });
}

}  // namespace

std::vector<Labels::Part> LabelDepths::of(const std::vector<int>& present) {
    const std::size_t count = voxels::count_of(lattice_.size);
    depths_.assign(count, {-depth_of_.most(), -depth_of_.most()});
    const bool keeps = count * present.size() * sizeof(float) <= most_kept_bytes;
    std::vector<std::vector<float>> kept;
    for (const int phase : present) {
        std::vector<float> depths = blurred(phase);
        enter(phase, depths);
        if (keeps) kept.push_back(std::move(depths));
    }
    settle();
    std::vector<VoxelGrid> grids;
    double steepest = 0;
    for (std::size_t i = 0; i < present.size(); ++i) {
        grids.push_back(grid_of(present[i], keeps ? std::move(kept[i]) : blurred(present[i])));
        steepest = std::max(steepest, grids.back().steepest_spline());
    }
    std::vector<Labels::Part> parts;
    for (std::size_t i = 0; i < present.size(); ++i) {
        // Divide all by the same number, so that each is 1-Lipschitz, even after rounding, and their differences keep
        // their signs.
        if (steepest > 0) grids[i].divide_by(steepest * (1 + 1e-6));
        parts.push_back({present[i], std::make_shared<const VoxelGrid>(std::move(grids[i]))});
    }
    return parts;
}

// The depth in a phase, from its blurred share.
std::vector<float> LabelDepths::blurred(int phase) const {
    std::vector<float> share(grid_.voxels.size());
    for_each_voxel(share.size(), [&](std::size_t i) { share[i] = phase_at(i) == phase ? 1.f : 0.f; });
    for (std::size_t axis = 0; axis < 3; ++axis) blur_.along(axis, share, lattice_.size);
    for_each_voxel(share.size(), [&](std::size_t i) { share[i] = depth_of_(share[i]); });
    return share;
}

// Records the depths in a phase at all voxels, both of the phase itself and of others.
void LabelDepths::enter(int phase, const std::vector<float>& depths) {
    for_each_voxel(depths.size(), [&](std::size_t i) {
        Depths& at = depths_[i];
        if (phase_at(i) == phase)
            at.own = depths[i];
        else
            at.others = std::max(at.others, depths[i]);
    });
}

void LabelDepths::settle() {
    for_each_voxel(depths_.size(), [&](std::size_t i) {
        Depths& at = depths_[i];
        const float ahead = at.own - at.others;
        const float margin = std::max(least_margin, std::min(-ahead, most_margin));
        // Raise the depth of the voxel's own phase by half of the deficit, and lower the others by the rest.
        at.own += 0.5f * std::max(margin - ahead, 0.f);
        at.others = at.own - margin;
    });
}

// The spline through minus the depths in a phase. Depths are in voxels. Multiplying them by the least spacing matters
// only if no depth changes anywhere; otherwise, all are eventually divided by the steepest slope.
VoxelGrid LabelDepths::grid_of(int phase, std::vector<float> depths) const {
    for_each_voxel(depths.size(), [&](std::size_t i) {
        depths[i] = phase_at(i) == phase ? depths_[i].own : std::min(depths[i], depths_[i].others);
    });
    for (std::size_t axis = 0; axis < 3; ++axis) voxels::to_spline_along(axis, depths, lattice_.size);
    const double least_spacing = std::min({lattice_.spacing.x, lattice_.spacing.y, lattice_.spacing.z});
    const auto scale = static_cast<float>(-least_spacing);
    const float most = depth_of_.most();
    for_each_voxel(depths.size(), [&](std::size_t i) {
        float d = depths[i];
        for (const float limit : {-most, most})
            if (std::abs(d - limit) < all_the_same) d = limit;
        depths[i] = scale * d;
    });
    return VoxelGrid::of_values("labels", lattice_, depths);
}

}  // namespace phasetree
