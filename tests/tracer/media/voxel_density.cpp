// Densities at voxels: values compared with the test's own trilinear interpolation, and bounds along rays.
#include "media/voxel_density.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/uniform.hpp"

namespace test_voxel_density {

using namespace phasetree;
using namespace phasetree::tracer;
using phasetree::tests::Uniform;

namespace {

// Numbers at voxels in a rotated, stretched grid that is mostly empty.
struct Cloud {
    VoxelLattice lattice{{21, 34, 9}, {-3, 5, 0.25}, {0.5, 0.25, 0.75}};
    VoxelPlacement placement{glm::dmat3{{0.72, 0.96, 1.6}, {-1.6, 1.2, 0}, {-0.96, -1.28, 1.2}}, {7, 1, -4}};
    std::vector<float> values;

    explicit Cloud(Uniform& random) {
        for (int z = 0; z < lattice.size[2]; ++z)
            for (int y = 0; y < lattice.size[1]; ++y)
                for (int x = 0; x < lattice.size[0]; ++x)
                    values.push_back(y > 6 && y < 27 && x < 15 ? 0.0f : 5.0f * random() * random());
    }
    VoxelDensity density() const { return {VoxelGrid::of_values("test", lattice, values), placement}; }

    glm::dvec3 scene_point(const glm::dvec3& voxel) const {
        return placement.linear * (lattice.first + voxel * lattice.spacing) + placement.translation;
    }
    // At a position in units of voxels.
    double at(const glm::dvec3& voxel) const {
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            double weight = 1;
            std::size_t index = 0;
            for (int i = 2; i >= 0; --i) {
                const int count = lattice.size[static_cast<std::size_t>(i)];
                if (voxel[i] < -0.5 || voxel[i] > count - 0.5) return 0;
                const double u = std::clamp(voxel[i], 0.0, count - 1.0);
                const int low = std::min(static_cast<int>(u), count - 2), up = corner >> i & 1;
                weight *= up != 0 ? u - low : 1 - (u - low);
                index = index * static_cast<std::size_t>(count) + static_cast<std::size_t>(low + up);
            }
            sum += weight * static_cast<double>(values[index]);
        }
        return sum;
    }
};

}  // namespace

TEST_CASE("the density is the trilinear interpolation over the greatest number, where the grid was placed") {
    Uniform random(41);
    const Cloud cloud(random);
    const VoxelDensity density = cloud.density();
    const auto greatest = static_cast<double>(density.greatest_number());
    double most = 0;
    for (const float v : cloud.values) most = std::max(most, static_cast<double>(v));
    CHECK(greatest == most);
    double worst = 0;
    int inside = 0;
    for (int n = 0; n < 20000; ++n) {
        glm::dvec3 voxel;
        for (int i = 0; i < 3; ++i)
            voxel[i] = -2 + (cloud.lattice.size[static_cast<std::size_t>(i)] + 3) * static_cast<double>(random());
        // Not within rounding of the grid's faces, where it ends.
        bool is_near_face = false;
        for (int i = 0; i < 3; ++i)
            for (const double face : {-0.5, cloud.lattice.size[static_cast<std::size_t>(i)] - 0.5})
                is_near_face = is_near_face || std::abs(voxel[i] - face) < 1e-4;
        if (is_near_face) continue;
        const glm::vec3 p(cloud.scene_point(voxel));
        const double expected = cloud.at(voxel) / greatest, found = static_cast<double>(density.at(p));
        worst = std::max(worst, std::abs(found - expected));
        inside += expected > 0;
        const Bounds& box = density.bounds();
        if (expected > 0)
            CHECK((glm::all(glm::greaterThanEqual(p, box.low)) && glm::all(glm::lessThanEqual(p, box.high))));
    }
    CHECK(inside > 5000);
    CHECK(worst < 1e-4);
}

TEST_CASE("along ways the stretches bound the density, follow each other, and leave out nothing") {
    Uniform random(42);
    const Cloud cloud(random);
    const VoxelDensity density = cloud.density();
    const glm::vec3 centre = density.bounds().centre(), extent = density.bounds().extent();
    std::size_t stretches = 0, empty = 0, tight = 0;
    for (int n = 0; n < 3000; ++n) {
        const auto somewhere = [&] {
            return centre + extent * (1.5f * (glm::vec3(random(), random(), random()) - 0.5f));
        };
        Way way{somewhere(), {}, 0};
        const glm::vec3 to = somewhere();
        way.direction = glm::normalize(to - way.origin);
        // Also along the grid's own axes, where rays never meet the faces of the other two axes.
        if (n % 4 == 0) way.direction = glm::vec3(glm::normalize(cloud.placement.linear[n / 4 % 3]));
        way.length = n % 5 == 0 ? std::numeric_limits<float>::infinity() : glm::length(to - way.origin);
        auto parts = density.stretches(way);
        std::vector<DensityStretch> all;
        while (const auto part = parts.next()) all.push_back(*part);
        const float end = std::isinf(way.length) ? 2 * glm::length(extent) : way.length;
        float sum = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            REQUIRE(all[i].from < all[i].to);
            REQUIRE(all[i].from >= (i == 0 ? 0.0f : all[i - 1].to));
            REQUIRE(all[i].to <= way.length);
            REQUIRE(all[i].bound > 0.0f);
            sum += all[i].to - all[i].from;
        }
        CHECK(sum <= parts.length() * 1.0001f);
        stretches += all.size();
        std::size_t next = 0;
        for (int k = 0; k < 200; ++k) {
            const float t = end * (static_cast<float>(k) + random()) / 200;
            const float found = density.at(way.origin + t * way.direction);
            while (next < all.size() && all[next].to < t) ++next;
            // Within rounding errors of a stretch's ends, the value may be that of either side.
            const auto covers = [&](std::size_t i, float by) {
                return i < all.size() && t >= all[i].from - by && t <= all[i].to + by;
            };
            float bound = 0;
            for (std::size_t i = next > 0 ? next - 1 : 0; i <= next + 1; ++i)
                if (covers(i, 1e-4f)) bound = std::max(bound, all[i].bound);
            CHECK(found <= bound + 1e-5f);
            empty += bound == 0.0f;
            tight += bound > 0.0f && bound < 0.9f;
        }
    }
    CHECK(stretches > 2000);
    CHECK(empty > 50000);
    CHECK(tight > 1000);
}

TEST_CASE("voxels that floats do not tell apart where they are placed are rejected, along whichever axis") {
    const auto made = [](const glm::dvec3& spacing, const VoxelPlacement& placement) {
        return VoxelDensity(
            VoxelGrid::of_voxels("test", {{4, 4, 4}, {0, 0, 0}, spacing}, [](int x, int, int) { return x; }),
            placement);
    };
    // Thin along z of the grid, which is along y of the scene, where it is far away.
    const glm::dmat3 turned{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    const glm::dvec3 thin(0.01, 0.01, 1e-5);
    CHECK_THROWS_AS((void)made(thin, {turned, {0, 1000, 0}}), std::invalid_argument);
    CHECK_THROWS_AS((void)made(thin, {glm::dmat3(1), {0, 0, 1000}}), std::invalid_argument);
    CHECK_NOTHROW((void)made(thin, {turned, {0, 1, 0}}));
    CHECK_THROWS_AS((void)made({1, 1, 1}, {glm::dmat3(1e-38), {0, 0, 0}}), std::invalid_argument);
    // However far a grid is from its own origin, its precision is that of its position in the scene.
    const VoxelLattice far_away{{4, 4, 4}, {1e6, 0, 0}, {0.01, 0.01, 0.01}};
    const VoxelDensity back(VoxelGrid::of_voxels("test", far_away, [](int x, int, int) { return x; }),
                            {glm::dmat3(1), {-1e6, 0, 0}});
    for (int i = 0; i < 30; ++i) {
        const float x = 0.001f * static_cast<float>(i);
        CHECK(back.at(glm::vec3(x, 0.015f, 0.015f)) == doctest::Approx(x / 0.03f).epsilon(1e-4));
    }
}

TEST_CASE("a grid without anything, of one voxel, and a way that passes it") {
    const VoxelLattice one{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}};
    const VoxelDensity nothing(VoxelGrid::of_values("test", one, {{0.0f}}), {});
    CHECK(nothing.greatest_number() == 0.0f);
    CHECK_FALSE(nothing.stretches({{0, 0, -3}, {0, 0, 1}, 10}).next());
    const VoxelDensity cube(VoxelGrid::of_values("test", one, {{4.0f}}), {});
    CHECK(cube.greatest_number() == 4.0f);
    CHECK(cube.at(glm::vec3{0.49f, -0.49f, 0.2f}) == 1.0f);
    CHECK(cube.at(glm::vec3{0.51f, 0, 0}) == 0.0f);
    auto through = cube.stretches({{0.2f, 0, -3}, {0, 0, 1}, 10});
    const auto stretch = through.next();
    REQUIRE(stretch);
    CHECK(stretch->from == 2.5f);
    CHECK(stretch->to == 3.5f);
    CHECK(stretch->bound == 1.0f);
    CHECK_FALSE(through.next());
    CHECK_FALSE(cube.stretches({{0.6f, 0, -3}, {0, 0, 1}, 10}).next());
    CHECK_FALSE(cube.stretches({{0, 0, -3}, {0, 0, -1}, 10}).next());
}

}  // namespace test_voxel_density
