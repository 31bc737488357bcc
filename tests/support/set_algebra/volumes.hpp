#pragma once

/// Grids of voxels, by the basis functions of their interpolation, over all voxels that are near.

#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "support/random_voxels.hpp"
#include "support/set_algebra/components.hpp"
#include "support/set_algebra/primitives.hpp"

namespace phasetree::tests::oracle {

/// The sum of the voxels' values, weighted by `basis` of the point's offset along each axis, in voxels.
template <class Basis>
double by_basis(const VoxelGrid& grid, const dvec3& p, double beyond, const Basis& basis) {
    const VoxelLattice& l = grid.lattice;
    const voxels::Table at(grid.table.data());
    dvec3 u;
    for (int a = 0; a < 3; ++a)
        u[a] =
            std::clamp((p[a] - l.first[a]) / l.spacing[a], -beyond, l.size[static_cast<std::size_t>(a)] - 1 + beyond);
    const auto near = [](double x) { return static_cast<int>(std::floor(x)); };
    const auto voxel = [&](int i, std::size_t a) { return std::clamp(i, 0, l.size[a] - 1); };
    double sum = 0;
    for (int z = near(u.z) - 2; z <= near(u.z) + 3; ++z)
        for (int y = near(u.y) - 2; y <= near(u.y) + 3; ++y)
            for (int x = near(u.x) - 2; x <= near(u.x) + 3; ++x)
                sum += basis(u.x - x) * basis(u.y - y) * basis(u.z - z) *
                       static_cast<double>(at(voxel(x, 0), voxel(y, 1), voxel(z, 2)));
    return sum;
}
inline double trilinear(const VoxelGrid& grid, const dvec3& p) {
    return by_basis(grid, p, 0, [](double d) { return std::max(1 - std::abs(d), 0.0); });
}
inline double triquadratic(const VoxelGrid& grid, const dvec3& p) {
    return by_basis(grid, p, 0.5, [](double d) {
        const double a = std::abs(d);
        return a < 0.5 ? 0.75 - a * a : a < 1.5 ? (1.5 - a) * (1.5 - a) / 2 : 0;
    });
}
inline double to_box_of(const VoxelLattice& l, const dvec3& p) {
    dvec3 half, middle;
    for (int a = 0; a < 3; ++a) {
        half[a] = 0.5 * l.size[static_cast<std::size_t>(a)] * l.spacing[a];
        middle[a] = l.first[a] - 0.5 * l.spacing[a] + half[a];
    }
    return box(p - middle, half);
}

inline double signed_value(const Volume& n, const dvec3& p) {
    const VoxelGrid& grid = *n.file.content;
    return std::max(to_box_of(grid.lattice, p), trilinear(grid, p));
}
inline bool member(const Volume& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

inline Phase region(const Labels& n, const dvec3& p) {
    if (to_box_of(n.parts.front().depth->lattice, p) >= 0) return vacuum;
    int least = 0;
    double depth = absent;
    for (const Labels::Part& part : n.parts)
        if (const double d = triquadratic(*part.depth, p); d < depth) {
            depth = d;
            least = part.phase;
        }
    return Phase{static_cast<std::uint8_t>(least)};
}
inline Components components(const Labels& n, const dvec3& p) {
    const double outside = to_box_of(n.parts.front().depth->lattice, p);
    Components r;
    for (const Labels::Part& part : n.parts) {
        double others = absent;
        for (const Labels::Part& other : n.parts)
            if (other.phase != part.phase) others = std::min(others, triquadratic(*other.depth, p));
        const auto i = static_cast<std::size_t>(part.phase);
        r[i] = n.parts.size() == 1 ? outside : (triquadratic(*part.depth, p) - others) / 2;
        if (i > 0) r[i] = std::max(r[i], outside);
    }
    r[0] = std::min(r[0], -outside);
    return r;
}

}  // namespace phasetree::tests::oracle

namespace phasetree::tests {

inline VoxelGrid random_content(Random& rng, std::type_identity<VoxelGrid>) {
    return random_level_set(rng);
}
inline LabelGrid random_content(Random& rng, std::type_identity<LabelGrid>) {
    return random_labels(rng, 2 + rng.below(3));
}
/// Images have no spacing of their own. There are as many numbers as the example's phases and the vacuum.
inline LabelGrid example_content(Random& rng, std::type_identity<LabelGrid>) {
    LabelGrid grid = random_labels(rng, 3);
    grid.has_spacing = false;
    return grid;
}

}  // namespace phasetree::tests
