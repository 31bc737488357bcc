// Meshes in which each triangle has separate corners, which differ by rounding, as in STL files from CAD programs.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/joined_vertices.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "support/random_mesh.hpp"
#include "support/written_files.hpp"

namespace test_rounded_corners {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

JoinedVertices joined(const TriangleMesh& mesh) {
    return join_vertices(mesh.vertices, mesh.triangles);
}

float unit_in_last_place(const TriangleMesh& mesh) {
    float largest = 0;
    for (const glm::vec3& v : mesh.vertices) largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return std::ldexp(1.0f, std::ilogb(largest) - 23);
}

/// Gives each triangle vertices of its own, as an STL file has them. `change(coordinate)` is called for each number.
template <class Change>
TriangleMesh separated(const TriangleMesh& mesh, const Change& change) {
    TriangleMesh soup;
    for (const glm::uvec3& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        for (int i = 0; i < 3; ++i) {
            glm::vec3 v = mesh.vertices[t[i]];
            for (int k = 0; k < 3; ++k) v[k] = change(v[k]);
            soup.vertices.push_back(v);
        }
        soup.triangles.emplace_back(first, first + 1, first + 2);
    }
    return soup;
}

/// The same triangles in another order, each from another corner on.
TriangleMesh shuffled(TriangleMesh mesh, Random& rng) {
    for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
        std::swap(mesh.triangles[i], mesh.triangles[static_cast<std::size_t>(rng.below(static_cast<int>(i + 1)))]);
        glm::uvec3& t = mesh.triangles[i];
        for (int turns = rng.below(3); turns > 0; --turns) t = {t.y, t.z, t.x};
    }
    return separated(mesh, [](float x) { return x; });
}

std::string said_of(const TriangleMesh& mesh) {
    try {
        Mesh node{.file = held(mesh)};
        node.prepare();
        return node.corners.empty() ? "a solid" : "repaired";
    } catch (const ModelError& e) {
        return e.what();
    }
}

/// A plate of this thickness in the unit square.
TriangleMesh plate(float thickness) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, i >> 1 & 1, i & 4 ? thickness : 0.f);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// A round block about x, as a CAD program writes it: each facet computes its corners from angles of its own.
std::string block_with_rounding() {
    std::string stl = "solid block\n";
    const auto facet = [&](std::initializer_list<glm::dvec3> corners) {
        stl += "facet normal 0 0 0\nouter loop\n";
        for (const glm::dvec3& p : corners) {
            const glm::vec3 v(p);
            stl += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", v.x, v.y, v.z);
        }
        stl += "endloop\nendfacet\n";
    };
    constexpr int sides = 24;
    const auto at = [&](double x, int side, int whole_turns) {
        const double angle = 2 * std::numbers::pi * side / sides + 2 * std::numbers::pi * whole_turns;
        return glm::dvec3(x, 0.4 * std::cos(angle), 0.4 * std::sin(angle));
    };
    for (int i = 0; i < sides; ++i) {
        facet({at(0, i, 0), at(0, i + 1, 1), at(1, i, 2)});
        facet({at(1, i, 3), at(0, i + 1, 0), at(1, i + 1, 1)});
        facet({{0, 0, 0}, at(0, i + 1, 2), at(0, i, 1)});
        facet({{1, 0, 1e-21}, at(1, i, 4), at(1, i + 1, 5)});
    }
    return stl + "endsolid\n";
}

}  // namespace

TEST_CASE("corners that differ by rounding are one, whatever the size of the mesh and of the noise") {
    Random rng(411);
    for (const float size : {1e-30f, 1e-3f, 1.f, 700.f, 1e8f})
        for (int n = 0; n < 5; ++n) {
            CAPTURE(size);
            TriangleMesh mesh = random_mesh(rng, 2, 0.5f);
            for (glm::vec3& v : mesh.vertices) v *= size;
            const float unit = unit_in_last_place(mesh);
            const auto near_zero = [&](float x) { return x == 0 ? rng.uniform(-1e-15f, 1e-15f) * size : x; };
            const auto last_bits = [&](float x) { return x + static_cast<float>(rng.below(3)) * unit; };
            const auto too_much = [&](float x) { return x + static_cast<float>(4 * rng.below(2)) * unit; };
            const std::size_t points = mesh.vertices.size();
            CHECK(joined(separated(mesh, near_zero)).points.size() == points);
            CHECK(joined(separated(mesh, last_bits)).points.size() == points);
            CHECK(joined(separated(mesh, too_much)).points.size() > points);
            if (size < 1e-3f) continue;
            CHECK(said_of(separated(mesh, near_zero)) == "a solid");
            CHECK(said_of(separated(mesh, last_bits)) == "a solid");
            CHECK(said_of(separated(mesh, too_much)) == "repaired");
        }
}

TEST_CASE("the surface is the same to the last bit in whatever order the triangles are") {
    Random rng(412);
    for (int n = 0; n < 20; ++n) {
        const TriangleMesh mesh = random_mesh(rng, 1 + n % 2, 0.5f);
        const float unit = unit_in_last_place(mesh);
        // Sometimes more than is joined, so that some corners stay apart.
        const int most = n % 4 == 3 ? 4 : 2;
        TriangleMesh soup = separated(mesh, [&](float x) {
            if (most > 2) return x + static_cast<float>(rng.below(most + 1)) * unit;
            return x == 0 ? rng.uniform(-1e-15f, 1e-15f) : x;
        });
        if (most > 2) {
            soup.triangles.pop_back();
            soup.vertices.resize(soup.vertices.size() - 3);
        }
        const TriangleMesh other = shuffled(soup, rng);
        CHECK(joined(soup).points == joined(other).points);
        REQUIRE(said_of(soup) == (most > 2 ? said_of(soup) : "a solid"));
        CHECK((said_of(soup) == "a solid") == (said_of(other) == "a solid"));
        if (most > 2) continue;
        const Field one = Mesh{.file = held(soup)}, two = Mesh{.file = held(other)};
        for (int k = 0; k < 200; ++k) {
            const glm::vec3 p = 1.5f * rng.uniform(0, 1) * rng.direction();
            REQUIRE(distance(one, p) == distance(two, p));
        }
    }
}

TEST_CASE("closed meshes keep all of their vertices, however near to each other") {
    TriangleMesh fine = octahedron_mesh();
    for (glm::vec3& v : fine.vertices) v *= 1e-12f;
    // Another part a metre away: all of the small part is within the tolerance.
    const TriangleMesh part = octahedron_mesh();
    for (const glm::vec3& v : part.vertices) fine.vertices.push_back(0.25f * v + glm::vec3(1, 0, 0));
    for (const glm::uvec3& t : part.triangles) fine.triangles.push_back(t + 6u);
    CHECK(joined(fine).points.size() == 12);
    CHECK(said_of(separated(fine, [](float x) { return x; })) == "a solid");
}

TEST_CASE("sheets farther from each other than the tolerance stay apart, also where corners are joined") {
    const float unit = std::ldexp(1.0f, -23);
    Random rng(413);
    const auto noise = [&](float x) { return x == 0 ? rng.uniform(-1e-15f, 1e-15f) : x; };
    CHECK(joined(separated(plate(3 * unit), noise)).points.size() == 8);
    CHECK(joined(separated(plate(1e-6f), noise)).points.size() == 8);
    CHECK(said_of(separated(plate(1e-5f), noise)) == "a solid");
    // Without noise also thinner ones do.
    CHECK(joined(separated(plate(unit), [](float x) { return x; })).points.size() == 8);
}

TEST_CASE("of a chain of near corners none are joined") {
    const float unit = std::ldexp(1.0f, -23);
    // Triangles about one corner each: at 0, 1.5 and 3 units, and at 0.5 and 0.75 units elsewhere.
    TriangleMesh mesh;
    for (const glm::vec3& p :
         {glm::vec3(0, 0, 0), {1.5f * unit, 0, 0}, {3 * unit, 0, 0}, {0, 0.5f, 0.5f * unit}, {0, 0.5f, 0.75f * unit}}) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size()), n = first / 3;
        mesh.vertices.insert(mesh.vertices.end(), {p, {1, 0.125f * static_cast<float>(n), 0}, {1, 0, 1}});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    // Five corners at x = 1 and one more, and of five corners two are joined.
    CHECK(joined(mesh).points.size() == 5 + 1 + 4);
    Random rng(414);
    for (int n = 0; n < 10; ++n) CHECK(joined(shuffled(mesh, rng)).points == joined(mesh).points);
}

TEST_CASE("a triangle is lost to joining only if the mesh is closed then") {
    // A sliver at a corner that one of the triangles there has elsewhere, by rounding.
    TriangleMesh mesh = octahedron_mesh();
    mesh.vertices.emplace_back(1, 1e-20f, 0);
    mesh.triangles[0].x = 6;
    CHECK(joined(mesh).points.size() == 6);
    mesh.triangles.emplace_back(0, 6, 4);
    CHECK(joined(mesh).points.size() == 6);
    CHECK(said_of(mesh) == "a solid");
    mesh.triangles.erase(mesh.triangles.begin() + 5);
    CHECK(joined(mesh).points.size() == 7);
    CHECK(said_of(mesh) == "repaired");
}

TEST_CASE("a small part does not vanish, and many points within the tolerance take little time") {
    Random rng(415);
    for (const float size : {1e-7f, 2e-7f}) {
        TriangleMesh mesh;
        for (std::uint32_t i = 0; i < 200'000; ++i) {
            for (int k = 0; k < 3; ++k)
                mesh.vertices.emplace_back(size * rng.uniform(-1, 1), size * rng.uniform(-1, 1),
                                           size * rng.uniform(-1, 1));
            mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        }
        mesh.vertices[0] = glm::vec3(1);
        CHECK(joined(mesh).points.size() > 500'000);
    }
}

TEST_CASE("files of solids with rounding are read as solids") {
    const WrittenFiles files(read_mesh);
    const TriangleMesh tetrahedron = files.read(
        "tetrahedron.stl",
        "solid\nfacet vertex 1e-20 0 0 vertex 0 1 0 vertex 1 0 0 endfacet\nfacet vertex 0 0 0 vertex 1 0 0 vertex 0 0 "
        "1 "
        "endfacet\nfacet vertex 0 0 0 vertex 0 0 1 vertex 0 1 0 endfacet\nfacet vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 "
        "endfacet\nendsolid\n");
    CHECK(said_of(tetrahedron) == "a solid");
    CHECK(said_of(files.read("block.stl", block_with_rounding())) == "a solid");
    CHECK(joined(files.read("block.stl", block_with_rounding())).points.size() == 2 * 24 + 2);
    // The other formats, too.
    CHECK(said_of(files.read(
              "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1e-20 0\nf 5 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")) ==
          "a solid");
    CHECK(said_of(
              files.read("a.ply",
                         "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
                         "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                         "0 0 1\n0 -1e-20 0\n3 4 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")) == "a solid");
}

}  // namespace test_rounded_corners
