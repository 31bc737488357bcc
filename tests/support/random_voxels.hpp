#pragma once

/// Grids of voxels for tests: random ones, and those of functions.

#include <cmath>
#include <memory>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "phasetree/nodes/phased/label_grid.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

/// The samples of a function f(dvec3) at the voxels' centres, divided by the steepest slope of their interpolation.
template <class F>
VoxelGrid sampled_grid(const VoxelLattice& lattice, F&& f) {
    VoxelGrid grid =
        VoxelGrid::make("volume", lattice, [&](const std::array<int, 3>& first, std::span<float, 512> values) {
            for (int i = 0; i < 512; ++i) {
                glm::dvec3 p;
                const std::array<int, 3> within{i & 7, (i >> 3) & 7, i >> 6};
                for (int a = 0; a < 3; ++a) {
                    const auto k = static_cast<std::size_t>(a);
                    p[a] = lattice.first[a] + lattice.spacing[a] * std::min(first[k] + within[k], lattice.size[k] - 1);
                }
                values[static_cast<std::size_t>(i)] = static_cast<float>(f(p));
            }
        });
    if (const double steepest = grid.steepest_linear(); steepest > 1) grid.divide_by(steepest * (1 + 1e-6));
    return grid;
}

template <class Content>
FromFile<Content> held_content(Content content) {
    FromFile<Content> file;
    file.content = std::make_shared<const Content>(std::move(content));
    return file;
}

/// A box of voxels within about a metre of the origin.
inline VoxelLattice random_lattice(Random& rng) {
    VoxelLattice lattice;
    for (int a = 0; a < 3; ++a) {
        const int n = 2 + rng.below(a == 0 ? 12 : 6);
        lattice.size[static_cast<std::size_t>(a)] = n;
        lattice.spacing[a] = 1.6 / n * static_cast<double>(rng.uniform(0.7f, 1));
        lattice.first[a] = -0.5 * (n - 1) * lattice.spacing[a] + static_cast<double>(rng.uniform(-0.1f, 0.1f));
    }
    return lattice;
}

/// Planes, balls with a narrow band, or noise.
inline VoxelGrid random_level_set(Random& rng) {
    const VoxelLattice lattice = random_lattice(rng);
    const glm::dvec3 direction(rng.direction());
    const int kind = rng.below(3);
    const auto radius = static_cast<double>(rng.uniform(0.3f, 0.6f));
    return sampled_grid(lattice, [&](const glm::dvec3& p) {
        if (kind == 0) return glm::dot(direction, p) - 0.1;
        if (kind == 1) return std::clamp(glm::length(p) - radius, -0.3, 0.3);
        return static_cast<double>(rng.uniform(-0.5f, 0.5f));
    });
}

/// Slabs, or a number for each voxel by chance.
inline LabelGrid random_labels(Random& rng, int numbers) {
    LabelGrid grid;
    grid.lattice = random_lattice(rng);
    grid.has_spacing = true;
    for (int i = 0; i < numbers; ++i) grid.numbers.push_back(i);
    const auto [nx, ny, nz] = grid.lattice.size;
    const bool is_slabs = rng.chance(0.5);
    const int along = rng.below(3);
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x) {
                const int at = along == 0 ? x : along == 1 ? y : z;
                grid.voxels.push_back(static_cast<std::uint8_t>(is_slabs ? at / 3 % numbers : rng.below(numbers)));
            }
    return grid;
}

}  // namespace phasetree::tests
