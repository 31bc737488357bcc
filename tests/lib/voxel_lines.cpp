// Lines of voxels: blurring and splines against their definitions, and the bound on slopes against all differences.
#include "nodes/voxels/lines.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "phasetree/nodes/fields/voxel_grid.hpp"

namespace test_voxel_lines {

using namespace phasetree;
using voxels::Size;

namespace {

std::vector<float> random_values(const Size& size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-1, 1);
    std::vector<float> values(voxels::count_of(size));
    for (float& v : values) v = value(random);
    return values;
}

// The value at a voxel; beyond the ends those of the ends.
double at(const std::vector<float>& values, const Size& size, std::array<int, 3> voxel) {
    for (std::size_t a = 0; a < 3; ++a) voxel[a] = std::clamp(voxel[a], 0, size[a] - 1);
    return static_cast<double>(values[static_cast<std::size_t>((voxel[2] * size[1] + voxel[1]) * size[0] + voxel[0])]);
}

template <class F>
void for_each_voxel(const Size& size, const F& f) {
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x) f(std::array{x, y, z});
}

std::array<int, 3> moved(std::array<int, 3> voxel, std::size_t axis, int by) {
    voxel[axis] += by;
    return voxel;
}

// Sizes that are multiples of the 16 lines of a bundle and of the 8 voxels of a block's side, and sizes that are not;
// and lines shorter than the reach of the blur.
const Size sizes[] = {{19, 5, 37}, {3, 33, 2}, {17, 16, 8}};

}  // namespace

TEST_CASE("blurring is the convolution with a Gaussian of a line that goes on beyond its ends as it ends") {
    for (const Size& size : sizes)
        for (const float sigma : {0.6f, 1.0f, 2.3f})
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::vector<float> before = random_values(size, 1);
                std::vector<float> after = before;
                voxels::Blur(sigma).along(axis, after, size);
                double worst = 0;
                for_each_voxel(size, [&](const std::array<int, 3>& voxel) {
                    double sum = 0, weights = 0;
                    const int reach = static_cast<int>(std::ceil(3.5f * sigma));  // where Blur cuts it off
                    for (int i = -reach; i <= reach; ++i) {
                        const double x = i / static_cast<double>(sigma), weight = std::exp(-0.5 * x * x);
                        sum += weight * at(before, size, moved(voxel, axis, i));
                        weights += weight;
                    }
                    worst = std::max(worst, std::abs(at(after, size, voxel) - sum / weights));
                });
                CAPTURE(sigma);
                CAPTURE(axis);
                CHECK(worst < 1e-6);
            }
}

TEST_CASE("the spline of the coefficients goes through the values") {
    for (const Size& size : sizes)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::vector<float> values = random_values(size, 2);
            std::vector<float> coefficients = values;
            voxels::to_spline_along(axis, coefficients, size);
            double worst = 0;
            for_each_voxel(size, [&](const std::array<int, 3>& voxel) {
                // Quadratic B-splines have the values 1/8, 6/8 and 1/8 at the voxels' centres.
                const double interpolated =
                    (at(coefficients, size, moved(voxel, axis, -1)) + 6 * at(coefficients, size, voxel) +
                     at(coefficients, size, moved(voxel, axis, 1))) /
                    8;
                worst = std::max(worst, std::abs(interpolated - at(values, size, voxel)));
            });
            CAPTURE(axis);
            CHECK(worst < 1e-6);
        }
}

TEST_CASE("the bound on a spline's slope is of the largest difference along each axis around a voxel") {
    for (const Size& size : sizes) {
        const VoxelLattice lattice{size, glm::dvec3(0), {0.5, 0.25, 0.4}};
        for (unsigned seed = 0; seed < 12; ++seed) {
            // In noise the largest differences along the axes are in different rows around a voxel, so that a row that
            // is left out is noticed.
            const std::vector<float> values = random_values(size, 3 + seed);
            double greatest = 0;  // squared
            for_each_voxel(size, [&](const std::array<int, 3>& voxel) {
                double sum = 0;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    double most = 0;
                    for (int k = -1; k <= 1; ++k)
                        for (int j = -1; j <= 1; ++j) {
                            const auto row = moved(moved(voxel, (axis + 1) % 3, j), (axis + 2) % 3, k);
                            for (const int i : {-1, 1})
                                most = std::max(
                                    most, std::abs(at(values, size, moved(row, axis, i)) - at(values, size, row)));
                        }
                    const double slope = most / lattice.spacing[static_cast<glm::length_t>(axis)];
                    sum += slope * slope;
                }
                greatest = std::max(greatest, sum);
            });
            const VoxelGrid grid = VoxelGrid::of_values("test", lattice, values);
            CHECK(grid.steepest_spline() == doctest::Approx(std::sqrt(greatest)).epsilon(1e-5));
            CHECK(grid.steepest_spline() >= std::sqrt(greatest));  // rounded upward, so that it is a bound
        }
    }
}

TEST_CASE("a grid that is made of all values at once is the one that is made voxel by voxel") {
    for (const Size& size : sizes) {
        const VoxelLattice lattice{size, glm::dvec3(0), glm::dvec3(1)};
        std::vector<float> values = random_values(size, 9);
        std::fill_n(values.begin(), values.size() / 2,
                    0.25f);  // so that the largest of the grids has blocks of one value, too
        const VoxelGrid each = VoxelGrid::of_voxels("test", lattice, [&](int x, int y, int z) {
            return static_cast<float>(at(values, size, {x, y, z}));
        });
        CHECK(VoxelGrid::of_values("test", lattice, values).table == each.table);
        values[values.size() - 2] = std::nanf("");
        CHECK_THROWS_WITH((void)VoxelGrid::of_values("test", lattice, values),
                          doctest::Contains("is too large, or not a number"));
    }
}

}  // namespace test_voxel_lines
