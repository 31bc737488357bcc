// Fields of voxels against the definition of their interpolation, and the bound on its slope against slopes that are
// seen.
#include "phasetree/nodes/fields/volume.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "phasetree/model/handle.hpp"
#include "support/random_voxels.hpp"
#include "support/set_algebra.hpp"

namespace test_volume {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

glm::vec3 point_about(const VoxelLattice& l, Random& rng) {
    glm::dvec3 p;
    for (int a = 0; a < 3; ++a) {
        const int n = l.size[static_cast<std::size_t>(a)];
        // Centres of voxels, faces of cells, places within and beyond.
        const double u =
            rng.chance(0.2) ? rng.below(n) : static_cast<double>(rng.uniform(-1.5f, static_cast<float>(n)));
        p[a] = l.first[a] + u * l.spacing[a];
    }
    return glm::vec3(p);
}

VoxelLattice cube(int n, double side) {
    return {{n, n, n}, glm::dvec3(-side / 2), glm::dvec3(side / (n - 1))};
}

float linear_at(const VoxelGrid& grid, const glm::vec3& p) {
    return voxels::linear_at(grid.table.data(), Vec3<float>{p.x, p.y, p.z});
}

}  // namespace

TEST_CASE("a volume is the trilinear interpolation of its voxels within their box") {
    Random rng(601);
    double worst = 0;
    for (int n = 0; n < 200; ++n) {
        const Field volume = Volume{.file = held_content(random_level_set(rng))};
        const VoxelLattice lattice = random_lattice(rng);
        for (int k = 0; k < 200; ++k) {
            const glm::vec3 p = point_about(lattice, rng);
            worst = std::max(worst, std::abs(static_cast<double>(distance(volume, p)) - value(volume, p)));
        }
    }
    MESSAGE("the greatest error is ", worst);
    CHECK(worst < 2e-6);
}

TEST_CASE("the values at the centres of voxels are those that were given") {
    const VoxelLattice lattice{{19, 9, 30}, {1, 2, 3}, {0.5, 0.25, 2}};
    const auto f = [](const glm::dvec3& p) { return 0.1 * p.x + 0.2 * p.y - 0.3 * p.z; };
    const VoxelGrid grid = sampled_grid(lattice, f);
    CHECK(grid.divided_by == 1);
    for (int z = 0; z < 30; ++z)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 19; ++x) {
                const glm::dvec3 p = lattice.first + lattice.spacing * glm::dvec3(x, y, z);
                REQUIRE(linear_at(grid, glm::vec3(p)) == doctest::Approx(f(p)).epsilon(1e-6));
            }
}

TEST_CASE("blocks of one value take no room") {
    const auto ball = [](const glm::dvec3& p) { return std::clamp(glm::length(p) - 0.7, -0.05, 0.05); };
    const VoxelGrid grid = sampled_grid(cube(128, 2), ball);
    MESSAGE(grid.bytes(), " bytes of ", 128 * 128 * 128 * 4);
    CHECK(grid.bytes() < std::size_t{128} * 128 * 128 * 4 / 2);
}

TEST_CASE("the steepest slope is that of some place and of no place more") {
    Random rng(602);
    for (int n = 0; n < 40; ++n) {
        const VoxelLattice lattice = random_lattice(rng);
        const std::uint64_t salt = rng.bits();
        const VoxelGrid grid = sampled_grid(lattice, [&](const glm::dvec3& p) { return 2 * hashed_noise(p, salt); });
        // It has been divided by that slope, which is at a voxel: near one the slope is 1, and nowhere more.
        REQUIRE(grid.divided_by > 1);
        double steepest = 0;
        constexpr double h = 1e-3;
        const auto at = [&](const glm::dvec3& p) { return static_cast<double>(linear_at(grid, glm::vec3(p))); };
        for (int z = 0; z < lattice.size[2]; ++z)
            for (int y = 0; y < lattice.size[1]; ++y)
                for (int x = 0; x < lattice.size[0]; ++x)
                    for (int octant = 0; octant < 8; ++octant) {
                        const glm::dvec3 p = lattice.first + lattice.spacing * glm::dvec3(x, y, z);
                        double sum = 0;
                        for (int a = 0; a < 3; ++a) {
                            glm::dvec3 step(0);
                            step[a] = (octant >> a & 1) != 0 ? h : -h;
                            const double slope = (at(p + step) - at(p)) / h;
                            sum += slope * slope;
                        }
                        steepest = std::max(steepest, std::sqrt(sum));
                    }
        REQUIRE(steepest < 1.001);
        REQUIRE(steepest > 0.98);
    }
}

TEST_CASE("samples of an exact distance are hardly steeper than it") {
    const auto ball = [](const glm::dvec3& p) { return std::clamp(glm::length(p) - 0.7, -0.1, 0.1); };
    const VoxelGrid grid = sampled_grid(cube(64, 2), ball);
    MESSAGE("divided by ", grid.divided_by);
    CHECK(grid.divided_by < 1.05);
}

TEST_CASE("outside of its box a volume is as far as the box at least, and a solid that reaches the border ends there") {
    const VoxelLattice lattice = cube(10, 1.8);
    const Field all = Volume{.file = held_content(sampled_grid(lattice, [](const glm::dvec3&) { return -1.; }))};
    CHECK(distance(all, {0, 0, 0}) == doctest::Approx(-1));
    CHECK(distance(all, {0.9f, 0, 0}) == doctest::Approx(-0.1));
    CHECK(distance(all, {3, 0, 0}) == doctest::Approx(2));
    CHECK(bounds(all).high.x == doctest::Approx(1));
    const Field none = Volume{.file = held_content(sampled_grid(lattice, [](const glm::dvec3&) { return 0.5; }))};
    CHECK(bounds(none).empty());
    CHECK(distance(none, {0, 0, 0}) == 0.5f);
    CHECK(distance(none, {5, 0, 0}) == doctest::Approx(4));
}

TEST_CASE("what is no grid is rejected") {
    const auto made = [](const VoxelLattice& lattice, double v) {
        return sampled_grid(lattice, [v](const glm::dvec3&) { return v; });
    };
    CHECK_THROWS_WITH(made({{0, 1, 1}, {}, glm::dvec3(1)}, 0), "volume: the grid is empty");
    CHECK_THROWS_WITH(made({{1, 9000, 1}, {}, glm::dvec3(1)}, 0),
                      "volume: the grid has 9000 voxels along an axis; the limit is 8192");
    CHECK_THROWS_WITH(
        made({{1, 1, 1}, {}, glm::dvec3(0, 1, 1)}, 0),
        "volume: the spacing of voxels must be from 1e-9 to 1e6 m, and their distance from the origin at most 1e9 m");
    CHECK_THROWS_WITH(made({{1, 1, 1}, {}, glm::dvec3(1)}, std::numeric_limits<double>::quiet_NaN()),
                      "volume: the value at the voxel (0, 0, 0) is too large, or not a number");
    CHECK_THROWS_WITH(
        made({{8192, 8192, 8192}, {}, glm::dvec3(1)}, 0),
        "volume: the grid spans 8192 × 8192 × 8192 voxels, or 1073741824 blocks of 8 × 8 × 8 "
        "including empty ones, but the limit is 15000000 blocks; crop it, split it, or resample it to larger voxels");
}

}  // namespace test_volume
