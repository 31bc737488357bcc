#include "nodes/label_depths.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace phasetree {

namespace {

// In voxels: by how much a voxel's own phase is deeper there than all others, at least. Where blurring has made another
// phase deeper by some amount, the own one leads by that amount afterwards, but by most_margin at most; else thin walls
// and threads would vanish.
constexpr float least_margin = 0.02f, most_margin = 0.3f;
// Depths nearer than this to the greatest or least depth are set to it, so that most blocks hold one value and take no
// room.
constexpr float all_the_same = 1e-4f;
// Blurred phases are needed twice. If they take more than this, they are blurred twice.
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
    own_.assign(count, {-depth_of_.most(), -depth_of_.most()});
    const bool keeps = count * present.size() * sizeof(float) <= most_kept_bytes;
    std::vector<std::vector<float>> kept;
    for (const int phase : present) {
        std::vector<float> depths = blurred(phase);
        compare_with_own(phase, depths);
        if (keeps) kept.push_back(std::move(depths));
    }
    set_margins();
    std::vector<VoxelGrid> grids;
    double steepest = 0;
    for (std::size_t i = 0; i < present.size(); ++i) {
        grids.push_back(grid_of(present[i], keeps ? std::move(kept[i]) : blurred(present[i])));
        steepest = std::max(steepest, grids.back().steepest_spline());
    }
    std::vector<Labels::Part> parts;
    for (std::size_t i = 0; i < present.size(); ++i) {
        // One divisor for all, so that each is 1-Lipschitz and their differences keep their signs.
        if (steepest > 0) grids[i].divide_by(steepest * (1 + 1e-6));
        parts.push_back({present[i], std::make_shared<const VoxelGrid>(std::move(grids[i]))});
    }
    return parts;
}

// The depth in a phase, from its share after blurring.
std::vector<float> LabelDepths::blurred(int phase) const {
    std::vector<float> share(grid_.voxels.size());
    for_each_voxel(share.size(), [&](std::size_t i) { share[i] = phase_at(i) == phase ? 1.f : 0.f; });
    for (std::size_t axis = 0; axis < 3; ++axis) blur_.along(axis, share, lattice_.size);
    for_each_voxel(share.size(), [&](std::size_t i) { share[i] = depth_of_(share[i]); });
    return share;
}

// Of the voxels that are the phase's takes the depth; of the others keeps the greatest depth of a phase that is not
// theirs, in place of the margin.
void LabelDepths::compare_with_own(int phase, const std::vector<float>& depths) {
    for_each_voxel(depths.size(), [&](std::size_t i) {
        if (phase_at(i) == phase)
            own_[i].depth = depths[i];
        else
            own_[i].margin = std::max(own_[i].margin, depths[i]);
    });
}

void LabelDepths::set_margins() {
    for_each_voxel(own_.size(), [&](std::size_t i) {
        Own& own = own_[i];
        // The own depth takes half of what is lacking; grid_of() lowers the others by the rest.
        const float ahead = own.depth - own.margin;
        own.margin = std::max(least_margin, std::min(-ahead, most_margin));
        own.depth += 0.5f * std::max(own.margin - ahead, 0.f);
    });
}

// The spline through minus the depths in a phase, in metres.
VoxelGrid LabelDepths::grid_of(int phase, std::vector<float> depths) const {
    for_each_voxel(depths.size(), [&](std::size_t i) {
        depths[i] = phase_at(i) == phase ? own_[i].depth : std::min(depths[i], own_[i].depth - own_[i].margin);
    });
    for (std::size_t axis = 0; axis < 3; ++axis) voxels::to_spline_along(axis, depths, lattice_.size);
    const double h = std::min({lattice_.spacing.x, lattice_.spacing.y, lattice_.spacing.z});
    const auto scale = static_cast<float>(-h);
    // Blocks that are deep in the phase, or far from it, hold one value.
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
