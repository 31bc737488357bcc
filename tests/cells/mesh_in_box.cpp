// Compares bounds of the distance to a mesh in a box with its values in the box, and tests rays through cells of
// meshes.
#include "bounding/mesh_in_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/compared_crossings.hpp"
#include "support/random_mesh.hpp"

namespace test_mesh_in_box {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct Found {
    std::size_t boxes = 0, known = 0, points = 0, outside = 0, beyond = 0;
};

void look(const Mesh& mesh, Random& rng, Found& found) {
    const TriangleMesh& triangles = *mesh.file.content;
    const auto vertex = [&] {
        return triangles.vertices[static_cast<std::size_t>(rng.below(static_cast<int>(triangles.vertices.size())))];
    };
    const glm::dvec3 middle =
        glm::dvec3(glm::mix(vertex(), vertex(), rng.chance(0.5) ? 0.f : 0.1f) + 0.05f * rng.direction());
    PointRange box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.centre[i] = static_cast<double>(static_cast<float>(middle[static_cast<int>(i)]));
        box.half_extents[i] = static_cast<double>(std::exp2(rng.uniform(-9, -3)));
    }
    std::vector<float> pieces;
    if (!Mesh::specialise(mesh.table.data(), box, {}, pieces)) return;
    ++found.boxes;
    const auto known = bounding::mesh_in_box(pieces.data(), box);
    if (!known) return;
    ++found.known;
    const auto at = [&](double larger) {
        glm::dvec3 p;
        for (std::size_t i = 0; i < 3; ++i) {
            const double u = rng.chance(0.5) ? (rng.chance(0.5) ? 1 : -1) : static_cast<double>(rng.uniform(-1, 1));
            p[static_cast<int>(i)] = box.centre[i] + u * larger * box.half_extents[i];
        }
        return p;
    };
    // The change of the value between two places is that of a gradient in the box.
    const auto is_possible = [&](double larger) {
        const glm::vec3 a(at(larger)), b(at(larger));
        double low = 0, high = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto d = static_cast<double>(b[static_cast<int>(i)] - a[static_cast<int>(i)]);
            const auto& g = known->gradients[i];
            low += std::min(g.low * d, g.high * d);
            high += std::max(g.low * d, g.high * d);
        }
        const auto value = [&](const glm::vec3& p) {
            return static_cast<double>(Mesh::distance(mesh.table.data(), Vec3<float>{p.x, p.y, p.z}));
        };
        const double change = value(b) - value(a), rounding = 1e-6;
        return change >= low - rounding && change <= high + rounding;
    };
    for (int k = 0; k < 40; ++k) {
        ++found.points;
        found.outside += !is_possible(1);
        found.beyond += !is_possible(30);
    }
}

}  // namespace

TEST_CASE("in a box the distance to a mesh changes as the bounds of its gradient say") {
    Random rng(321);
    Found found;
    for (int n = 0; n < (long_tests() ? 500 : 30); ++n) {
        Mesh mesh{.file = held(random_mesh(rng, 1 + n % 4, n % 2 == 0 ? 0.9f : 0.4f))};
        mesh.prepare();
        for (int box = 0; box < 60; ++box) look(mesh, rng, found);
    }
    MESSAGE(found.boxes, " boxes, ", found.known, " with bounds, ", found.points,
            " points; in boxes thirty times as large ", found.beyond, " would be outside");
    CHECK(found.outside == 0);
    CHECK(found.known > found.boxes / 10);
    CHECK(found.beyond > found.points / 100);
}

TEST_CASE("so does the distance to a wall along an open mesh") {
    Random rng(323);
    Found found;
    for (int n = 0; n < (long_tests() ? 500 : 30); ++n) {
        TriangleMesh open = random_mesh(rng, 1 + n % 4, n % 2 == 0 ? 0.9f : 0.4f);
        open.triangles.resize(open.triangles.size() / 2);
        if (n % 3 == 0)
            for (std::size_t t = 0; t < open.triangles.size(); t += 3)
                std::swap(open.triangles[t].x, open.triangles[t].y);
        Mesh mesh{.file = held(std::move(open)), .thickness = 0.05f};
        mesh.prepare();
        for (int box = 0; box < 60; ++box) look(mesh, rng, found);
    }
    MESSAGE(found.boxes, " boxes, ", found.known, " with bounds, ", found.points,
            " points; in boxes thirty times as large ", found.beyond, " would be outside");
    CHECK(found.outside == 0);
    CHECK(found.known > found.boxes / 20);
    CHECK(found.beyond > found.points / 100);
}

TEST_CASE("rays through cells of meshes find what marching through the whole finds") {
    Random rng(322);
    Compared all;
    for (int n = 0; n < (long_tests() ? 200 : 6); ++n) {
        TriangleMesh triangles = random_mesh(rng, 1 + n % 2, 0.5f);
        const bool is_wall = n % 2 == 1;
        if (is_wall) triangles.triangles.resize(triangles.triangles.size() / 2);
        const Field mesh = Mesh{.file = held(std::move(triangles)), .thickness = is_wall ? 0.15f : 0};
        const Field other = Mesh{.file = held(random_mesh(rng, 1, 0.3f))};
        const Field twisted = warped(Twist{.rate = 60}, other);
        const Phased object =
            n % 3 == 0   ? Phased(Set{.phase = Phase{1}, .of = mesh})
            : n % 3 == 1 ? Phased(Under{.of = {Set{.phase = Phase{1}, .of = Shell{.of = mesh, .half_thickness = 0.05f}},
                                               Set{.phase = Phase{2}, .of = mesh}}})
                         : Phased(Under{.of = {Set{.phase = Phase{1},
                                                   .of = warped(Rotate{.axis = rng.direction(), .angle = 40}, mesh)},
                                               Set{.phase = Phase{2}, .of = warped(Scale{.factor = 1.2f}, twisted)}}});
        compare_crossings(object, {}, long_tests() ? 1000 : 150, rng, all);
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings");
    CHECK(all.crossings > all.rays / 2);
    CHECK(all.different == 0);
}

}  // namespace test_mesh_in_box
