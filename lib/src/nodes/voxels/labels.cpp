// Maps the numbers of a grid to phases, and determines the positions of its voxels. nodes/voxels/label_depths.hpp makes
// the fields.
#include "phasetree/nodes/phased/labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/preparation.hpp"
#include "nodes/voxels/label_depths.hpp"

namespace phasetree {

namespace {

constexpr int no_phase = -1;

bool is_whole(float x) {
    return x == std::floor(x) && std::abs(x) <= 16777216.f;
}

// The phases of the numbers that occur in the grid.
std::vector<int> phases_of_numbers(const Labels& n) {
    const LabelGrid& grid = *n.file.content;
    std::vector<int> phases;
    for (const std::int32_t number : grid.numbers) {
        const auto is_number = [&](float v) { return static_cast<double>(v) == static_cast<double>(number); };
        int phase = no_phase;
        for (std::size_t i = 0; i < n.of_phases.size(); ++i) {
            const float value = n.values.empty() ? static_cast<float>(i + 1) : n.values[i];
            if (is_number(value)) phase = n.of_phases[i].index;
        }
        const bool is_empty = n.empty.empty() ? number == 0 : std::ranges::any_of(n.empty, is_number);
        if (phase == no_phase && is_empty) phase = vacuum.index;
        phases.push_back(phase);
    }
    return phases;
}

void refuse_unknown_number(const LabelGrid& grid, const std::vector<int>& phases) {
    const auto unknown = std::ranges::find_if(grid.voxels, [&](std::uint8_t v) { return phases[v] == no_phase; });
    if (unknown == grid.voxels.end()) return;
    const auto at = static_cast<std::size_t>(unknown - grid.voxels.begin());
    const auto [nx, ny, nz] = grid.lattice.size;
    const auto x = at % static_cast<std::size_t>(nx),
               y = at / static_cast<std::size_t>(nx) % static_cast<std::size_t>(ny),
               z = at / static_cast<std::size_t>(nx) / static_cast<std::size_t>(ny);
    throw ModelError(
        fmt::format("labels: the voxel ({}, {}, {}), counted from 0, has the number {}, which belongs to no phase; add "
                    "it to \"values\", or to \"empty\" for the vacuum",
                    x, y, z, grid.numbers[*unknown]));
}

// The positions of the voxels: those given by the grid, or centred on the origin.
VoxelLattice placed(const LabelGrid& grid, const glm::vec3& spacing) {
    VoxelLattice lattice = grid.lattice;
    const bool is_given = spacing.x > 0 && spacing.y > 0 && spacing.z > 0;
    if (grid.has_spacing) {
        if (spacing != glm::vec3(0)) throw ModelError("labels: the grid has its own spacing; remove \"spacing\"");
        return lattice;
    }
    if (!is_given)
        throw ModelError(
            "labels: images do not store the size of their voxels; \"spacing\" must be [x, y, z], each positive");
    lattice.spacing = glm::dvec3(spacing);
    for (glm::length_t i = 0; i < 3; ++i)
        lattice.first[i] = -0.5 * (lattice.size[static_cast<std::size_t>(i)] - 1) * lattice.spacing[i];
    return lattice;
}

}  // namespace

void Labels::prepare() {
    const LabelGrid& content = *file.content;
    if (!values.empty() && values.size() != of_phases.size())
        throw ModelError(fmt::format("labels: \"values\" needs one entry for each of the {} phases, but has {}",
                                     of_phases.size(), values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!is_whole(values[i]) ||
            std::count(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]))
            throw ModelError("labels: \"values\" must be different whole numbers");
    if (!std::ranges::all_of(empty, is_whole)) throw ModelError("labels: \"empty\" must be whole numbers");
    if (voxels::count_of(content.lattice.size) > LabelGrid::max_voxels)
        throw ModelError(fmt::format("labels: the grid has more than {} voxels", LabelGrid::max_voxels));
    if (content.voxels.empty() || content.voxels.size() != voxels::count_of(content.lattice.size))
        throw ModelError("labels: the grid lacks some of its voxels");
    const std::vector<int> phase_of = phases_of_numbers(*this);
    refuse_unknown_number(content, phase_of);

    const VoxelLattice lattice = placed(content, spacing);
    std::array<bool, Phase::capacity> is_present{};
    for (const std::uint8_t v : content.voxels) is_present[static_cast<std::size_t>(phase_of[v])] = true;
    std::vector<int> present;
    for (int i = 0; i < Phase::capacity; ++i)
        if (is_present[static_cast<std::size_t>(i)]) present.push_back(i);
    model::PreparationTogether::pay(info.name, content.voxels.size() * present.size());
    parts = LabelDepths(content, lattice, phase_of, smoothing).of(present);

    const Bounds extent = parts.front().depth->extent();
    box = {extent.centre(), extent.extent() * 0.5f};
    solid = extent;
    // There are no other phases where the vacuum's block and all blocks around it have its greatest depth.
    if (parts.size() > 1 && parts.front().phase == vacuum.index) {
        solid = {};
        for (std::size_t i = 1; i < parts.size(); ++i) {
            const VoxelGrid& depth = *parts[i].depth;
            const double most =
                DepthOfShare::most(smoothing) * std::min({lattice.spacing.x, lattice.spacing.y, lattice.spacing.z});
            const auto lowest = static_cast<float>(most / depth.divided_by * (1 - 1e-5));
            const Bounds blocks = depth.blocks_below(lowest);
            if (!blocks.empty()) solid = unite(solid, blocks);
        }
    }
}

}  // namespace phasetree
