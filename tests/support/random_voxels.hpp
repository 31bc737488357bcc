#pragma once

/// Voxel grids for tests: random ones, and samples of functions.

#include <bit>
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
    VoxelGrid grid = VoxelGrid::of_voxels("volume", lattice, [&](int x, int y, int z) {
        return f(lattice.first + lattice.spacing * glm::dvec3(x, y, z));
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

/// A number from −0.5 to 0.5 that depends only on the position, because voxels between blocks are requested more than
/// once.
inline double hashed_noise(const glm::dvec3& p, std::uint64_t salt) {
    for (int a = 0; a < 3; ++a) salt = Random(salt ^ std::bit_cast<std::uint64_t>(p[a])).bits();
    return static_cast<double>(Random(salt).uniform(-0.5f, 0.5f));
}

/// Planes, balls with a narrow band, or noise.
inline VoxelGrid random_level_set(Random& rng) {
    const VoxelLattice lattice = random_lattice(rng);
    const glm::dvec3 direction(rng.direction());
    const int kind = rng.below(3);
    const auto radius = static_cast<double>(rng.uniform(0.3f, 0.6f));
    const std::uint64_t salt = rng.bits();
    return sampled_grid(lattice, [&](const glm::dvec3& p) {
        if (kind == 0) return glm::dot(direction, p) - 0.1;
        if (kind == 1) return std::clamp(glm::length(p) - radius, -0.3, 0.3);
        return hashed_noise(p, salt);
    });
}

/// Slabs, or a random number for each voxel.
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
