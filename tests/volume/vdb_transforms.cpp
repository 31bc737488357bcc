// Grids whose axes are swapped, mirrored, rotated or sheared, against OpenVDB's own sampling in world space.
#include <doctest/doctest.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "scene/voxels.hpp"
#include "support/random_voxels.hpp"
#include "volume/vdb_folder.hpp"

namespace test_vdb_transforms {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

namespace fs = std::filesystem;

// The box of voxels that have values, over several leaves and unlike along each axis.
const openvdb::CoordBBox box({-5, 2, -3}, {12, 9, 4});

openvdb::math::Transform::Ptr transform_of(const glm::dmat3& linear, const glm::dvec3& translation) {
    openvdb::Mat4R m = openvdb::Mat4R::identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) m(i, j) = linear[i][j];
        m(3, i) = translation[i];
    }
    return openvdb::math::Transform::createLinearTransform(m);
}

// Of the three axes, in all orders and directions.
std::vector<glm::dmat3> signed_permutations() {
    std::vector<glm::dmat3> all;
    std::array<int, 3> order{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            glm::dmat3 m(0.0);
            for (int i = 0; i < 3; ++i) m[i][order[static_cast<std::size_t>(i)]] = (signs >> i & 1) != 0 ? -1 : 1;
            all.push_back(m);
        }
    } while (std::ranges::next_permutation(order).found);
    return all;
}

glm::dmat3 scaled(const glm::dmat3& m, const glm::dvec3& lengths) {
    return {m[0] * lengths[0], m[1] * lengths[1], m[2] * lengths[2]};
}

template <class Grid>
typename Grid::Ptr random_grid(double background, double low, double high, std::uint64_t seed) {
    auto grid = Grid::create(static_cast<typename Grid::ValueType>(background));
    Random rng(seed);
    for (auto at = box.begin(); at != box.end(); ++at)
        grid->tree().setValueOn(
            *at, static_cast<typename Grid::ValueType>(rng.uniform(static_cast<float>(low), static_cast<float>(high))));
    return grid;
}

// A place in the world within the voxels that have values.
openvdb::Vec3d random_place(const openvdb::GridBase& grid, Random& rng) {
    openvdb::Vec3d p;
    for (int i = 0; i < 3; ++i)
        p[i] = box.min()[i] + static_cast<double>(rng.uniform(0, 1)) * (box.max()[i] - box.min()[i]);
    return grid.indexToWorld(p);
}
glm::vec3 floats(const openvdb::Vec3d& p) {
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}
using Sampler = openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler>;
double sampled(const Sampler& sampler, const glm::vec3& p) {
    return static_cast<double>(sampler.wsSample(openvdb::Vec3d(p.x, p.y, p.z)));
}

// The greatest difference between the numbers of a medium's grid and OpenVDB's samples, of which many are not 0.
double worst_of_numbers(const VdbFolder& folder, const openvdb::FloatGrid::Ptr& grid) {
    tracer::Voxels voxels{.file = folder.write("numbers.vdb", {grid})};
    voxels.prepare();
    const Sampler sampler(*grid);
    Random rng(5);
    double worst = 0;
    for (int k = 0; k < 400; ++k) {
        const glm::vec3 p = floats(random_place(*grid, rng));
        const double expected = sampled(sampler, p);
        REQUIRE(expected > 0);
        worst =
            std::max(worst, std::abs(static_cast<double>(voxels.shares->at(p) * voxels.greatest_number()) - expected));
    }
    return worst;
}

}  // namespace

TEST_CASE("level sets with axes in any order and direction") {
    const VdbFolder folder;
    double worst = 0;
    std::size_t inside = 0;
    for (const glm::dmat3& m : signed_permutations())
        for (const glm::dvec3 lengths : {glm::dvec3(0.25), glm::dvec3(0.2, 0.3, 0.25)}) {
            const auto grid = random_grid<openvdb::FloatGrid>(0.3, -0.2, 0.2, 21);
            grid->setGridClass(openvdb::GRID_LEVEL_SET);
            grid->setTransform(transform_of(scaled(m, lengths), {1, -2, 0.5}));
            const VoxelGrid read = tracer::read_level_set(folder.write("a.vdb", {grid}), "");
            const Field volume = Volume{.file = held_content(read)};
            const Sampler sampler(*grid);
            Random rng(22);
            for (int k = 0; k < 100; ++k) {
                const glm::vec3 p = floats(random_place(*grid, rng));
                const double expected = sampled(sampler, p);
                const double found = static_cast<double>(distance(volume, p)) * read.divided_by;
                worst = std::max(worst, std::abs(found - expected));
                inside += found < 0;
            }
        }
    MESSAGE(inside, " of 9600 points are inside; the greatest difference is ", worst);
    CHECK(inside > 2000);
    CHECK(worst < 1e-5);
}

TEST_CASE("labels with axes in any order and direction") {
    const VdbFolder folder;
    auto grid = openvdb::Int32Grid::create(0);
    Random rng(23);
    for (auto at = box.begin(); at != box.end(); ++at)
        if (rng.chance(0.5)) grid->tree().setValueOn(*at, 1 + rng.below(3));
    for (const glm::dmat3& m : signed_permutations()) {
        grid->setTransform(transform_of(scaled(m, {0.2, 0.3, 0.25}), {1, -2, 0.5}));
        const Phased object = Labels{.file = held_content(tracer::read_label_grid(folder.write("l.vdb", {grid}), "")),
                                     .of_phases = {Phase{1}, Phase{2}, Phase{3}},
                                     .values = {},
                                     .empty = {},
                                     .grid = {}};
        std::size_t wrong = 0;
        for (auto at = box.begin(); at != box.end(); ++at) {
            if (rng.chance(0.8)) continue;
            const glm::vec3 p = floats(grid->indexToWorld(*at));
            wrong += label(distances(object, p)).index != grid->tree().getValue(*at);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("numbers with axes in any order, direction and angle, and with sheared ones") {
    const VdbFolder folder;
    const auto grid = random_grid<openvdb::FloatGrid>(0, 0.5, 3, 24);
    double worst = 0;
    const auto read_with = [&](const glm::dmat3& linear) {
        grid->setTransform(transform_of(linear, {1, -2, 0.5}));
        worst = std::max(worst, worst_of_numbers(folder, grid));
    };
    for (const glm::dmat3& m : signed_permutations()) read_with(scaled(m, {0.2, 0.3, 0.25}));
    Random rng(25);
    for (int k = 0; k < 20; ++k) {
        const glm::dmat3 turned(
            glm::rotate(glm::dmat4(1), static_cast<double>(rng.uniform(0, 6)), glm::dvec3(rng.direction())));
        glm::dmat3 sheared = scaled(turned, {0.2, 0.3, 0.25});
        if (k % 2 == 1) sheared[1] += 0.5 * sheared[0] - 0.7 * sheared[2];
        if (k % 3 == 1) sheared[0] = -sheared[0];
        read_with(sheared);
    }
    MESSAGE("the greatest difference is ", worst);
    CHECK(worst < 5e-5);
}

TEST_CASE("a rotated grid can be placed in the scene as any other") {
    const VdbFolder folder;
    const auto grid = random_grid<openvdb::FloatGrid>(0, 0.5, 3, 26);
    const glm::dmat3 turned(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
    grid->setTransform(transform_of(scaled(turned, {0.2, 0.3, 0.25}), {1, -2, 0.5}));
    tracer::Voxels voxels{
        .file = folder.write("numbers.vdb", {grid}), .scale = 2, .rotate_z_degrees = 90, .translate = {3, 4, 5}};
    voxels.prepare();
    const Sampler sampler(*grid);
    Random rng(27);
    double worst = 0;
    for (int k = 0; k < 400; ++k) {
        const openvdb::Vec3d p = random_place(*grid, rng);
        const glm::vec3 moved = 2.f * glm::vec3(floats({-p.y(), p.x(), p.z()})) + glm::vec3(3, 4, 5);
        const double found = static_cast<double>(voxels.shares->at(moved) * voxels.greatest_number());
        worst = std::max(worst, std::abs(found - static_cast<double>(sampler.wsSample(p))));
    }
    CHECK(worst < 1e-4);
}

TEST_CASE("axes that are rotated by rounding errors alone count as straight") {
    const VdbFolder folder;
    const auto grid = random_grid<openvdb::FloatGrid>(0.3, -0.2, 0.2, 28);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    // A quarter turn in floats.
    const double cosine = static_cast<double>(std::cos(std::acos(-1.0f) / 2));
    REQUIRE(std::abs(cosine) > 1e-9);
    grid->setTransform(transform_of(0.25 * glm::dmat3{{cosine, 1, 0}, {-1, cosine, 0}, {0, 0, 1}}, {1, -2, 0.5}));
    CHECK(said_of_level_set(folder.write("a.vdb", {grid})) == "nothing");
}

TEST_CASE("which transforms are rejected") {
    const VdbFolder folder;
    const auto set = random_grid<openvdb::FloatGrid>(0.3, -0.2, 0.2, 29);
    set->setGridClass(openvdb::GRID_LEVEL_SET);
    auto labels = openvdb::Int32Grid::create(0);
    labels->tree().setValueOn({0, 0, 0}, 1);
    const auto numbers = random_grid<openvdb::FloatGrid>(0, 0.5, 3, 30);
    const auto turned = transform_of(glm::dmat3(glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(0, 0, 1))), {});
    set->setTransform(turned);
    labels->setTransform(turned);
    const std::string straight =
        "its voxels are not aligned with the axes; align the grid, and rotate it in the scene with \"rotate\" or "
        "\"affine\"";
    CHECK(said_of_level_set(folder.write("s.vdb", {set})) == straight);
    CHECK(said_of_labels(folder.write("l.vdb", {labels})) == straight);
    numbers->setTransform(
        openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 2));
    CHECK(said_of_numbers(folder.write("f.vdb", {numbers})) ==
          "its voxels differ in size, as in a camera frustum; resample it to a uniform grid");
    // OpenVDB itself refuses to make a transform that has no inverse, but not one that nearly has none.
    numbers->setTransform(transform_of(glm::dmat3{{1, 0, 0}, {1, 1e-7, 0}, {0, 0, 1}}, {}));
    CHECK(said_of_numbers(folder.write("z.vdb", {numbers})) == "its transform is singular: its voxels have no volume");
}

}  // namespace test_vdb_transforms
