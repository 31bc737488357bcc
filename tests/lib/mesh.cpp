// Compares fields of meshes with evaluating their triangles one by one. Meshes that need repair are tested in
// lib/mesh_repair.
#include "phasetree/nodes/fields/mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/model/preparation_watch.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_mesh.hpp"
#include "support/set_algebra.hpp"
#include "support/set_algebra/meshes.hpp"

namespace test_mesh {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

void append(TriangleMesh& mesh, const TriangleMesh& part, const glm::vec3& offset, float scale = 1) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec3& v : part.vertices) mesh.vertices.push_back(offset + scale * v);
    for (const glm::uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
}
TriangleMesh turned(TriangleMesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

/// Points near and far, on vertices, edges and faces, and straight above vertices and edges.
glm::vec3 point_about(const TriangleMesh& mesh, Random& rng) {
    if (rng.chance(0.3)) return (rng.chance(0.1) ? 100.f : 1.5f) * rng.uniform(0, 1) * rng.direction();
    const glm::uvec3 t = mesh.triangles[static_cast<std::size_t>(rng.below(static_cast<int>(mesh.triangles.size())))];
    const glm::vec3 &a = mesh.vertices[t.x], &b = mesh.vertices[t.y], &c = mesh.vertices[t.z];
    const float u = rng.chance(0.3) ? 0 : rng.uniform(0, 1), v = rng.chance(0.3) ? 0 : rng.uniform(0, 1 - u);
    const glm::vec3 on = a + u * (b - a) + v * (c - a);
    if (rng.chance(0.1)) return on;
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const glm::vec3 away = rng.chance(0.5) && normal != glm::vec3(0) ? glm::normalize(normal) : rng.direction();
    return on + rng.uniform(-0.3f, 0.3f) * (rng.chance(0.5) ? 0.01f : 1.f) * away;
}

/// Triangles without order: sheets that cross, open edges, edges of three triangles, equal triangles both ways, and one
/// without area.
TriangleMesh random_soup(Random& rng) {
    TriangleMesh mesh = random_mesh(rng, 1 + rng.below(2), 0.3f);
    const auto corner = [&] { return static_cast<std::uint32_t>(rng.below(static_cast<int>(mesh.vertices.size()))); };
    std::erase_if(mesh.triangles, [&](const glm::uvec3&) { return rng.chance(0.5); });
    for (int k = 0; k < 4; ++k) mesh.triangles.push_back({corner(), corner(), corner()});
    const glm::uvec3 first = mesh.triangles[0];
    mesh.triangles.push_back({first.y, first.x, first.z});
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(0.5f * (mesh.vertices[first.x] + mesh.vertices[first.y]));
    mesh.triangles.push_back({first.x, middle, first.y});
    return mesh;
}

/// The distance to the nearest triangle, in double precision. One without area is its sides, and one with two equal
/// corners does not count.
double to_soup(const TriangleMesh& mesh, const glm::dvec3& p) {
    double nearest = 1e30;
    oracle::for_each_triangle(mesh, [&](const std::vector<glm::dvec3>& t) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
        for (std::size_t i = 0; i < 3; ++i) nearest = std::min(nearest, oracle::to_edge(p, t[i], t[(i + 1) % 3]));
        if (glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) > 1e-6)
            nearest = std::min(nearest, oracle::to_polygon(p, t));
    });
    return nearest;
}

/// The error message for a mesh; "a solid" if it is accepted.
std::string said_of(TriangleMesh mesh) {
    try {
        const Field field = Mesh{.file = held(std::move(mesh))};
        (void)field;
    } catch (const ModelError& e) {
        return e.what();
    }
    return "a solid";
}

}  // namespace

TEST_CASE("the distance is that to the nearest triangle, with the sign of the winding number") {
    Random rng(311);
    std::size_t points = 0, inside = 0;
    double worst = 0;
    for (int n = 0; n < (long_tests() ? 2000 : 40); ++n) {
        TriangleMesh mesh = random_mesh(rng, rng.below(4), rng.chance(0.5) ? 0.1f : 0.5f);
        if (rng.chance(0.3)) append(mesh, random_mesh(rng, 1, 0.3f), {2.5f, 0, 0.5f});
        if (rng.chance(0.3)) append(mesh, turned(octahedron_mesh()), {0, 0, 0}, 0.01f);  // a bubble
        const Field field = Mesh{.file = held(mesh)};
        for (int k = 0; k < 500; ++k) {
            const glm::vec3 p = point_about(mesh, rng);
            const double expected = tests::value(field, p);
            const auto found = static_cast<double>(phasetree::distance(field, p));
            const double rounding = 4e-7 * (1 + static_cast<double>(glm::length(p)));
            worst = std::max(worst, std::abs(found - expected) / rounding);
            if (std::abs(expected) > rounding) REQUIRE((found < 0) == (expected < 0));
            ++points;
            inside += expected < 0;
        }
    }
    MESSAGE(points, " points, ", inside, " inside; the worst error is ", worst, " of what rounding may do");
    CHECK(worst < 1);
    CHECK(inside > points / 10);
}

TEST_CASE("a wall is what is near any triangle of a mesh") {
    Random rng(317);
    std::size_t points = 0, inside = 0;
    double worst = 0;
    for (int n = 0; n < (long_tests() ? 1000 : 40); ++n) {
        const TriangleMesh mesh = random_soup(rng);
        const float thickness = rng.uniform(0.01f, 0.3f);
        const Field field = Mesh{.file = held(mesh), .thickness = thickness};
        const Bounds box = bounds(field);
        for (int k = 0; k < 300; ++k) {
            const glm::vec3 p = point_about(mesh, rng), q = p + rng.uniform(0, 0.3f) * rng.direction();
            const double expected = to_soup(mesh, p) - static_cast<double>(thickness) / 2;
            const auto found = static_cast<double>(phasetree::distance(field, p));
            const double rounding = 4e-7 * (1 + static_cast<double>(glm::length(p)));
            worst = std::max(worst, std::abs(found - expected) / rounding);
            const float change = std::abs(distance(field, p) - distance(field, q));
            REQUIRE(change <= glm::length(p - q) + 1e-6f * (1 + glm::length(p)));
            if (expected < -rounding) REQUIRE(box.contains(p));
            ++points;
            inside += expected < 0;
        }
    }
    MESSAGE(points, " points, ", inside, " inside; the worst error is ", worst, " of what rounding may do");
    CHECK(worst < 1);
    CHECK(inside > points / 10);
    CHECK(inside < points);
}

TEST_CASE("a sheet needs a thickness, and then its edges are round") {
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    CHECK(said_of(square).find("Make a wall of it by \"thickness\"") != std::string::npos);
    const Field wall = Mesh{.file = held(square), .thickness = 0.2f};
    const auto at = [&](float x, float y, float z) { return distance(wall, {x, y, z}); };
    CHECK(at(0.5f, 0.5f, 0.3f) == doctest::Approx(0.2));
    CHECK(at(0.5f, 0.5f, -0.3f) == doctest::Approx(0.2));
    CHECK(at(0.5f, 0.25f, 0) == doctest::Approx(-0.1));
    CHECK(at(1.3f, 0.5f, 0.4f) == doctest::Approx(0.4));  // 0.5 from the edge
    CHECK(at(1.2f, 1.2f, 0.1f) == doctest::Approx(0.2));  // 0.3 from the corner
    CHECK(bounds(wall).high.x == doctest::Approx(1.1));
}

TEST_CASE("preparing a large mesh reports its progress, and can be cancelled") {
    Random rng(318);
    TriangleMesh mesh = random_mesh(rng, 5, 0.5f);
    append(mesh, random_mesh(rng, 5, 0.5f), {0.7f, 0.2f, 0.1f});
    std::vector<float> shares;
    {
        const PreparationWatch watch({.cancelled = {}, .progress = [&](std::string_view node, float share) {
                                          CHECK(node == "mesh");
                                          shares.push_back(share);
                                      }});
        Mesh{.file = held(mesh)}.prepare();
    }
    CHECK(std::ranges::is_sorted(shares));
    REQUIRE(shares.size() > 4);
    CHECK(shares.front() == 0);
    CHECK(shares.back() == 1);
    const std::size_t all = shares.size();
    Mesh{.file = held(mesh)}.prepare();
    CHECK(shares.size() == all);
    // Wherever it is cancelled.
    std::atomic<int> polls = 0;
    const auto polls_until = [&](int most) {
        polls = 0;
        const PreparationWatch watch({.cancelled = [&polls, most] { return ++polls > most; }, .progress = {}});
        Mesh{.file = held(mesh)}.prepare();
    };
    polls_until(std::numeric_limits<int>::max() - 100);
    const int needed = polls;
    CHECK(needed > 20);
    // The number of polls depends on the threads, so not at the very last one.
    for (const int most : {0, 1, needed / 4, needed / 2, 3 * needed / 4})
        CHECK_THROWS_AS(polls_until(most), PreparationCancelled);
}

TEST_CASE("of two points, the distances differ by no more than theirs") {
    Random rng(312);
    const TriangleMesh mesh = random_mesh(rng, 3, 0.2f);
    const Field field = Mesh{.file = held(mesh)};
    for (int n = 0; n < 20'000; ++n) {
        const glm::vec3 p = point_about(mesh, rng), q = p + rng.uniform(0, 0.3f) * rng.direction();
        const float change = std::abs(distance(field, p) - distance(field, q));
        REQUIRE(change <= glm::length(p - q) + 1e-6f * (1 + glm::length(p)));
    }
}

TEST_CASE("the search finds the piece that a loop over all of them would, to the last bit") {
    Random rng(313);
    for (int n = 0; n < 20; ++n) {
        const TriangleMesh mesh = random_mesh(rng, 1 + n % 3, 0.3f);
        Mesh node{.file = held(mesh)};
        node.prepare();
        for (int k = 0; k < 500; ++k) {
            const glm::vec3 p = point_about(mesh, rng);
            const Vec3<float> at{p.x, p.y, p.z};
            const float searched = Mesh::distance(node.table.data(), at);
            const float looped = mesh::PieceList::distance(node.table.data(), at);
            REQUIRE(std::memcmp(&searched, &looped, sizeof searched) == 0);
        }
    }
}

TEST_CASE("in a box a mesh is few pieces, to the last bit") {
    Random rng(314);
    std::size_t boxes = 0, points = 0, refused = 0, beyond = 0, pieces = 0;
    for (int n = 0; n < (long_tests() ? 400 : 20); ++n) {
        const TriangleMesh mesh = random_mesh(rng, 2 + n % 3, 0.5f);
        Mesh node{.file = held(mesh)};
        node.prepare();
        for (int b = 0; b < 40; ++b) {
            const glm::vec3 middle = point_about(mesh, rng);
            PointRange box;
            for (std::size_t i = 0; i < 3; ++i) {
                box.centre[i] = static_cast<double>(middle[static_cast<int>(i)]);
                box.half_extents[i] = static_cast<double>(std::exp2(rng.uniform(-10, -3)));
            }
            ++boxes;
            std::vector<float> list, part;
            if (!Mesh::specialise(node.table.data(), box, {}, list)) {
                ++refused;
                continue;
            }
            REQUIRE(Mesh::Specialised::is_sound(list));
            PointRange half = box;
            for (double& r : half.half_extents) r /= 2;
            REQUIRE(Mesh::specialise(node.table.data(), half, list, part));
            for (int kind = 0; kind < 3; ++kind)
                pieces += static_cast<std::size_t>(list[static_cast<std::size_t>(kind)]);
            const auto compare = [&](const std::vector<float>& floats, const PointRange& in, double larger) {
                Vec3<float> p;
                float* axes[] = {&p.x, &p.y, &p.z};
                for (std::size_t i = 0; i < 3; ++i) {
                    const double u = rng.chance(0.5) ? (rng.chance(0.5) ? 1 : -1) : rng.uniform(-1, 1);
                    *axes[i] = static_cast<float>(in.centre[i] + u * larger * in.half_extents[i]);
                }
                const float whole = Mesh::distance(node.table.data(), p);
                const float few = Mesh::Specialised::distance(floats.data(), p);
                return std::memcmp(&whole, &few, sizeof whole) == 0;
            };
            for (int k = 0; k < 20; ++k) {
                ++points;
                REQUIRE(compare(list, box, 1));
                REQUIRE(compare(part, half, 1));
                beyond += !compare(list, box, 8);
            }
        }
    }
    MESSAGE(boxes, " boxes, ", refused, " refused, ",
            static_cast<double>(pieces) / static_cast<double>(boxes - refused),
            " pieces; in boxes eight times as large ", beyond, " of ", points, " points would be different");
    CHECK(refused < boxes / 2);
    CHECK(beyond > points / 100);
}

TEST_CASE("a clean mesh is used as it is, and any other is repaired") {
    const auto is_repaired = [](TriangleMesh mesh) {
        Mesh node{.file = held(std::move(mesh))};
        node.prepare();
        return !node.corners.empty();
    };
    const TriangleMesh solid = octahedron_mesh();
    CHECK(!is_repaired(solid));
    TriangleMesh mesh = solid;
    append(mesh, turned(solid), {0, 0, 0}, 0.25f);
    CHECK(!is_repaired(mesh));
    mesh = solid;
    mesh.triangles.pop_back();
    CHECK(is_repaired(mesh));
    mesh = solid;
    std::swap(mesh.triangles[7].y, mesh.triangles[7].z);
    CHECK(is_repaired(mesh));
    CHECK(is_repaired(turned(solid)));
    for (const glm::vec3& offset : {glm::vec3(0.25f, 0.1f, 0.3f), {2, 0, 0}, {0.5f, 0.5f, 0}}) {
        mesh = solid;
        append(mesh, solid, offset);
        CHECK(is_repaired(mesh));
    }
    mesh = solid;
    append(mesh, solid, {0, 0, 0}, 0.25f);
    CHECK(is_repaired(mesh));
    mesh = solid;
    append(mesh, turned(solid), {5, 0, 0});
    CHECK(is_repaired(mesh));
}

TEST_CASE("bad numbers are rejected, with the place") {
    const TriangleMesh solid = octahedron_mesh();
    CHECK(said_of(solid) == "a solid");
    CHECK(said_of({}) == "mesh: it has no triangles");
    TriangleMesh mesh = solid;
    mesh.triangles[0].x = 99;
    CHECK(said_of(mesh) == "mesh: it has a triangle (1) with a vertex that does not exist");
    mesh = solid;
    mesh.vertices[2].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(said_of(mesh).starts_with(
        "mesh: it has a vertex (3) that is farther than 1e9 m from the origin, or not a number"));
}

TEST_CASE("corners at the same place are one, and triangles with two equal corners are ignored") {
    TriangleMesh soup;
    const TriangleMesh solid = octahedron_mesh();
    for (const glm::uvec3& t : solid.triangles) {
        for (int i = 0; i < 3; ++i) soup.vertices.push_back(solid.vertices[t[i]]);
        const auto n = static_cast<std::uint32_t>(soup.vertices.size());
        soup.triangles.push_back({n - 3, n - 2, n - 1});
        soup.triangles.push_back({n - 3, n - 1, n - 1});
    }
    const Field whole = Mesh{.file = held(solid)}, parts = Mesh{.file = held(soup)};
    Random rng(315);
    for (int n = 0; n < 1000; ++n) {
        const glm::vec3 p = point_about(solid, rng);
        REQUIRE(distance(whole, p) == distance(parts, p));
    }
}

TEST_CASE(
    "the distance is the same to the last bit in whatever order a file has vertices, triangles and their corners") {
    Random rng(316);
    for (int n = 0; n < 20; ++n) {
        const TriangleMesh mesh = random_mesh(rng, 1 + n % 2, 0.3f);
        TriangleMesh other{{mesh.vertices.rbegin(), mesh.vertices.rend()}, {}};
        const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::uvec3 u = last - t;
            other.triangles.push_back(
                std::array{u, glm::uvec3(u.y, u.z, u.x), glm::uvec3(u.z, u.x, u.y)}[rng.below(3)]);
        }
        for (std::size_t i = other.triangles.size() - 1; i > 0; --i)
            std::swap(other.triangles[i],
                      other.triangles[static_cast<std::size_t>(rng.below(static_cast<int>(i + 1)))]);
        const Field one = Mesh{.file = held(mesh)}, two = Mesh{.file = held(other)};
        for (int k = 0; k < 500; ++k) {
            const glm::vec3 p = point_about(mesh, rng);
            REQUIRE(distance(one, p) == distance(two, p));
        }
    }
}

TEST_CASE("far away and where coordinates are infinite, the distance is positive") {
    const Field field = Mesh{.file = held(octahedron_mesh())};
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float far : {1e3f, 1e9f, 1e18f, 1e30f, infinity})
        for (const glm::vec3& p : {glm::vec3(far, 0, 0), {-far, far, 0}, {0, far, -far}}) CHECK(distance(field, p) > 0);
}

}  // namespace test_mesh
