// Positions of an OpenVDB grid's voxels in the world, and their conversion to a lattice along the axes.
//
// Only openvdb.cpp includes this, because OpenVDB's headers are large.
#pragma once

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree::tracer {

// The steps between voxels along the three index axes, as vectors in the world.
inline glm::dmat3 steps_of(const openvdb::GridBase& grid) {
    const openvdb::math::Transform& transform = grid.transform();
    if (!transform.isLinear())
        throw std::runtime_error("its voxels differ in size, as in a camera frustum; resample it to a uniform grid");
    glm::dmat3 steps;
    for (int i = 0; i < 3; ++i) {
        openvdb::Vec3d along(0, 0, 0);
        along[i] = 1;
        const openvdb::Vec3d step = transform.baseMap()->applyJacobian(along);
        steps[i] = {step[0], step[1], step[2]};
    }
    const double lengths = glm::length(steps[0]) * glm::length(steps[1]) * glm::length(steps[2]);
    if (!(std::abs(glm::determinant(steps)) > 1e-6 * lengths) || !std::isfinite(lengths))
        throw std::runtime_error("its transform is singular: its voxels have no volume");
    return steps;
}

inline glm::dvec3 centre_of(const openvdb::GridBase& grid, const openvdb::Coord& voxel) {
    const openvdb::Vec3d p = grid.transform().indexToWorld(voxel);
    return {p[0], p[1], p[2]};
}

inline std::array<int, 3> size_of(const openvdb::CoordBBox& box) {
    std::array<int, 3> size{};
    for (int i = 0; i < 3; ++i) {
        const long long n = static_cast<long long>(box.max()[i]) - box.min()[i] + 1;
        if (n > VoxelGrid::max_along_axis)
            throw std::runtime_error(
                fmt::format("it has {} voxels along an axis; the limit is {}", n, VoxelGrid::max_along_axis));
        size[static_cast<std::size_t>(i)] = static_cast<int>(n);
    }
    return size;
}

// How the voxels in a box of a grid are ordered in a lattice.
struct VoxelOrder {
    openvdb::Coord first;                ///< the grid's voxel that comes first in the lattice
    std::array<openvdb::Coord, 3> step;  ///< the step to the next voxel along each of the lattice's axes

    explicit VoxelOrder(const openvdb::CoordBBox& box) : first(box.min()), step{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}} {}

    openvdb::Coord operator()(int x, int y, int z) const {
        openvdb::Coord at = first;
        for (int i = 0; i < 3; ++i) at[i] += x * step[0][i] + y * step[1][i] + z * step[2][i];
        return at;
    }
};

struct OrderedLattice {
    VoxelLattice lattice;
    VoxelOrder order;
};

// The lattice of a box of voxels whose index axes are parallel to the world's axes, in any order and direction; nullopt
// if they are not. A step may deviate by a millionth of the shortest one, as it does for transforms stored in floats.
// That moves the voxels of the largest lattice by a hundredth of their size.
inline std::optional<OrderedLattice> lattice_along_axes(const openvdb::GridBase& grid, const openvdb::CoordBBox& box) {
    const glm::dmat3 steps = steps_of(grid);
    const std::array<int, 3> size = size_of(box);
    const double shortest = std::min({glm::length(steps[0]), glm::length(steps[1]), glm::length(steps[2])});
    OrderedLattice found{{}, VoxelOrder(box)};
    std::array<bool, 3> is_taken{};
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 along = glm::abs(steps[i]);
        const int axis = along.x > along.y && along.x > along.z ? 0 : along.y > along.z ? 1 : 2;
        const auto at = static_cast<std::size_t>(axis);
        for (int j = 0; j < 3; ++j)
            if (j != axis && !(along[j] <= 1e-6 * shortest)) return std::nullopt;
        if (std::exchange(is_taken[at], true)) return std::nullopt;
        const bool is_mirrored = steps[i][axis] < 0;
        found.lattice.size[at] = size[static_cast<std::size_t>(i)];
        found.lattice.spacing[axis] = along[axis];
        found.order.step[at] = {0, 0, 0};
        found.order.step[at][i] = is_mirrored ? -1 : 1;
        if (is_mirrored) found.order.first[i] = box.max()[i];
    }
    found.lattice.first = centre_of(grid, found.order.first);
    return found;
}

inline OrderedLattice lattice_of(const openvdb::GridBase& grid, const openvdb::CoordBBox& box) {
    if (auto found = lattice_along_axes(grid, box)) return *std::move(found);
    throw std::runtime_error(
        "its voxels are not aligned with the axes; align the grid, and rotate it in the scene with \"rotate\" or "
        "\"affine\"");
}

}  // namespace phasetree::tracer
