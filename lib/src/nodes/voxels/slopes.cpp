// Computes the steepest slopes of the interpolation between the voxels of a grid.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace phasetree {

namespace {

// The maximum of f(values) over all stored blocks, but at least 0. In other blocks, and next to them, the values are
// constant.
template <class F>
double largest_at_kept_blocks(const std::vector<float>& table, F&& f) {
    const float* values = voxels::Table(table.data()).values;
    const auto count = static_cast<std::size_t>(table.data() + table.size() - values) / VoxelGrid::kept_values;
    constexpr std::size_t at_once = 64;
    std::vector<double> largest((count + at_once - 1) / at_once, 0.0);
    tbb::parallel_for(std::size_t{0}, largest.size(), [&](std::size_t chunk) {
        for (std::size_t i = chunk * at_once; i < std::min((chunk + 1) * at_once, count); ++i)
            largest[chunk] = std::max(largest[chunk], f(values + i * VoxelGrid::kept_values));
    });
    return largest.empty() ? 0.0 : *std::ranges::max_element(largest);
}

// The same for f(pointer to a voxel's value); the neighbours along x, y and z are 1, 10 and 100 floats before and after
// it. Voxels after the grid's last ones are copies, where nothing is steeper than at the originals.
template <class F>
double largest_at_kept_voxels(const std::vector<float>& table, F&& f) {
    return largest_at_kept_blocks(table, [&](const float* block) {
        double largest = 0;
        for (int z = 1; z <= VoxelGrid::block_side; ++z)
            for (int y = 1; y <= VoxelGrid::block_side; ++y)
                for (int x = 1; x <= VoxelGrid::block_side; ++x)
                    largest = std::max(largest, f(block + x + 10 * y + 100 * z));
        return largest;
    });
}

double squared(double x) {
    return x * x;
}

}  // namespace

// In a cell between eight voxels, the derivative along x is linear along y and along z and does not depend on x. So the
// square of the slope is convex along each axis, and largest at one of the eight voxels, where the derivatives are the
// differences to the neighbours.
double VoxelGrid::steepest_linear() const {
    const double steepest = largest_at_kept_voxels(table, [&](const float* v) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int step = std::array{1, 10, 100}[axis];
            const float most = std::max(std::abs(v[step] - v[0]), std::abs(v[-step] - v[0]));
            sum += squared(static_cast<double>(most) / lattice.spacing[static_cast<glm::length_t>(axis)]);
        }
        return sum;
    });
    return std::sqrt(steepest) * (1 + 1e-6);
}

namespace {

// Parameters are passed by value, so that loops over them are vectorised.
float larger(float a, float b) {
    return a < b ? b : a;
}

// For all voxels of a block at once: the largest of the values before, at and after each voxel along an axis.
void larger_of_three(std::array<float, VoxelGrid::kept_values>& values, std::size_t stride) {
    const std::array<float, VoxelGrid::kept_values> original = values;
    for (std::size_t i = stride; i < original.size() - stride; ++i)
        values[i] = larger(original[i], larger(original[i - stride], original[i + stride]));
}

}  // namespace

// The derivative along x is an average of the differences along x between the 27 voxels, so it is at most the largest
// of them. The bound of the slope combines the largest differences along each axis, which need not occur at one point.
// They are computed for all voxels of a block at once, one axis after the other. The results of these loops for voxels
// at the block's border wrap around it, and are not used. The sum of squares is first computed in floats, which lose
// less than a part in 10⁵, and again in doubles where it may be the largest.
double VoxelGrid::steepest_spline() const {
    using Block = std::array<float, kept_values>;
    const glm::vec3 inverse(1.0 / lattice.spacing);
    const double steepest = largest_at_kept_blocks(table, [&](const float* v) {
        std::array<Block, 3> most;
        Block rough{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::array<std::size_t, 3> stride{1, 10, 100};
            const std::size_t step = stride[axis];
            Block& along = most[axis];
            along.fill(0.f);
            for (std::size_t i = step; i < kept_values - step; ++i)
                along[i] = larger(std::abs(v[i + step] - v[i]), std::abs(v[i] - v[i - step]));
            larger_of_three(along, stride[(axis + 1) % 3]);
            larger_of_three(along, stride[(axis + 2) % 3]);
            const float per_length = inverse[static_cast<glm::length_t>(axis)];
            for (std::size_t i = 0; i < kept_values; ++i) rough[i] += along[i] * per_length * (along[i] * per_length);
        }
        double largest = 0;
        float least = 0;  // of the rough sums of squares that may be larger
        for (std::size_t z = 1; z <= 8; ++z)
            for (std::size_t y = 1; y <= 8; ++y)
                for (std::size_t x = 1; x <= 8; ++x) {
                    const std::size_t i = x + 10 * y + 100 * z;
                    if (rough[i] < least) continue;
                    double sum = 0;
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        sum += squared(static_cast<double>(most[axis][i]) /
                                       lattice.spacing[static_cast<glm::length_t>(axis)]);
                    largest = std::max(largest, sum);
                    least = static_cast<float>(largest) * (1 - 1e-5f);
                }
        return largest;
    });
    return std::sqrt(steepest) * (1 + 1e-6);
}

}  // namespace phasetree
