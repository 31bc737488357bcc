// Rays in cells of meshes meet the triangles themselves: against labels in double and against triangles in double, one
// by one.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "cells/cells_file.hpp"
#include "cells/cells_files.hpp"
#include "cells/validate.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/affine.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/stretch.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/compared_crossings.hpp"
#include "support/random_mesh.hpp"

namespace test_mesh_faces {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Phased solid(const Field& field) {
    return Set{.phase = Phase{1}, .of = field};
}
Field field_of(const TriangleMesh& mesh) {
    return Mesh{.file = held(mesh)};
}

// A mesh alone or beside something else, in the space of the object or mapped to it.
constexpr int ways = 7;
Phased object_of(const Field& mesh, int way, Random& rng) {
    switch (way) {
        case 0:
            return solid(mesh);
        case 1:
            return solid(warped(Translate{.by = {0.3f, -0.2f, 5}}, warped(Rotate{.axis = rng.direction(), .angle = 70},
                                                                          warped(Scale{.factor = 0.7f}, mesh))));
        case 2:
            return solid(warped(Stretch{.factors = {1, 0.6f, 1.7f}}, mesh));
        case 3:  // a mirror
            return solid(warped(Affine{.x = {-1, 0.2f, 0}, .y = {0, 1.1f, 0}, .z = {0.1f, 0, 0.9f}}, mesh));
        case 4:  // the mesh is a hole
            return solid(Difference{.from = Box{.size = glm::vec3(2.5f)}, .subtract = {mesh}});
        case 5:
            return solid(Union{.of = {mesh, warped(Translate{.by = {0.9f, 0.3f, 0}}, mesh)}});
        default:  // coincident faces
            return Under{.of = {solid(mesh), Set{.phase = Phase{2}, .of = Box{.size = glm::vec3(1.2f)}},
                                Set{.phase = Phase{3}, .of = mesh}}};
    }
}

struct Line {
    glm::vec3 origin, direction;
};

// Through a vertex, through a point on an edge, along a face, or anywhere. Every other line starts on the mesh's box,
// so that coordinates are round.
Line line_about(const TriangleMesh& mesh, Random& rng) {
    const glm::uvec3 t = mesh.triangles[static_cast<std::size_t>(rng.below(static_cast<int>(mesh.triangles.size())))];
    const glm::vec3 &a = mesh.vertices[t.x], &b = mesh.vertices[t.y], &c = mesh.vertices[t.z];
    const glm::vec3 from = rng.chance(0.5) ? 2.f * rng.direction() : glm::vec3(0, 0, 3);
    const int kind = rng.below(4);
    if (kind == 0) return {from, glm::normalize(a - from)};
    if (kind == 1) return {from, glm::normalize(glm::mix(a, b, rng.uniform(0, 1)) - from)};
    if (kind == 2) {
        const glm::vec3 along = glm::normalize(b - a + rng.uniform(-1, 1) * (c - a));
        const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
        const float above = rng.chance(0.3) ? 0 : (rng.chance(0.5) ? 1.f : -1.f) * std::exp2(-rng.uniform(4, 24));
        return {(a + b + c) / 3.f + above * n - 2.f * along, along};
    }
    return {from, glm::normalize(rng.in({glm::vec3(-1), glm::vec3(1)}) - from)};
}

struct Counted {
    std::size_t lines = 0, crossings = 0, points = 0, wrong = 0, stuck = 0;
    TraceCounters counters{};
};

// Follows a ray from phase to phase, and compares the phases between its crossings with those of set algebra in double,
// wherever an interface is farther than a resolution.
void follow(const Phased& object, const CellsAlongRay& cells, const Line& line, Counted& counted) {
    Evaluator::Workspace w;
    const auto resolution = static_cast<double>(cells.cells().resolution());
    const glm::dvec3 o(line.origin), d(line.direction);
    glm::vec3 p = line.origin;
    Phase phase = cells.cells().label(p, w);
    double since = 0;
    ++counted.lines;
    for (int n = 0;; ++n) {
        if (n == 1000) {
            ++counted.stuck;
            return;
        }
        const auto next = nearest_crossing(cells, p, line.direction, phase, w, counted.counters);
        const double until = next ? glm::dot(glm::dvec3(next->p_from) - o, d) : since + 4;
        for (int i = 0; i < 12; ++i) {
            const double t = since + 4 * resolution + (until - since - 8 * resolution) * (i + 0.5) / 12;
            if (!(t > since && t < until)) continue;
            const glm::dvec3 q = o + t * d;
            const Components values = tests::values(object, q);
            if (values.interface_distance() < resolution) continue;
            ++counted.points;
            counted.wrong += tests::label(object, q) != phase;
        }
        if (!next) return;
        ++counted.crossings;
        since = glm::dot(glm::dvec3(next->p_to) - o, d);
        p = next->p_to;
        phase = next->to;
    }
}

// The distances at which a line crosses triangles, in double. Nothing if it is too close to an edge for that.
std::optional<std::vector<double>> crossings_in_double(const TriangleMesh& mesh, const Line& line, double margin) {
    std::vector<double> found;
    const glm::dvec3 o(line.origin), d(line.direction);
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::dvec3, 3> q;
        for (int i = 0; i < 3; ++i) q[static_cast<std::size_t>(i)] = glm::dvec3(mesh.vertices[t[i]]) - o;
        // The distances from the line to the edges, as seen along it.
        double least = 1e30, most = -1e30;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = q[i], &b = q[(i + 1) % 3];
            const double beside = glm::dot(d, glm::cross(a, b)) / glm::length(glm::cross(d, b - a));
            least = std::min(least, beside);
            most = std::max(most, beside);
        }
        if (least < -margin && most > margin) continue;
        if (!(least > margin || most < -margin)) return std::nullopt;
        const glm::dvec3 n = glm::cross(q[1] - q[0], q[2] - q[0]);
        found.push_back(glm::dot(n, q[0]) / glm::dot(n, d));
    }
    std::erase_if(found, [](double t) { return t < 0; });
    std::ranges::sort(found);
    return found;
}

}  // namespace

TEST_CASE("rays through cells of meshes are in the phases of set algebra") {
    Random rng(331);
    for (int way = 0; way < ways; ++way) {
        CAPTURE(way);
        Counted counted;
        for (int n = 0; n < (long_tests() ? 60 : 3); ++n) {
            const TriangleMesh mesh = n % 3 == 0 ? octahedron_mesh() : random_mesh(rng, 1 + n % 2, 0.4f);
            const Phased object = object_of(field_of(mesh), way, rng);
            const InterfaceCells cells(object, {.quality = any_quality(rng)});
            const CellsAlongRay boxes(cells);
            const InterfaceTracer tracer(object);
            Evaluator::Workspace w;
            for (int i = 0; i < (long_tests() ? 500 : 120); ++i) {
                const ComparedRay any = compared_ray(tracer, i % 4 == 1, rng, w);
                const bool is_about = i % 2 == 0 && way != 1 && way != 2 && way != 3;
                follow(object, boxes, is_about ? line_about(mesh, rng) : Line{any.origin, any.direction}, counted);
            }
        }
        MESSAGE(counted.lines, " rays, ", counted.crossings, " crossings, ", counted.points, " points, ",
                counted.counters.visits, " visits, ", counted.counters.batches, " batches");
        CHECK(counted.wrong == 0);
        CHECK(counted.stuck == 0);
        CHECK(counted.crossings > counted.lines);
        CHECK(counted.points > counted.lines);
    }
}

TEST_CASE("where a ray is not close to an edge, it meets the triangles that it meets in double") {
    Random rng(332);
    std::size_t lines = 0, crossings = 0, bad_normals = 0;
    double farthest = 0;
    TraceCounters counters;
    for (int n = 0; n < (long_tests() ? 60 : 6); ++n) {
        const TriangleMesh mesh = random_mesh(rng, 1 + n % 3, 0.4f);
        const InterfaceCells cells(solid(field_of(mesh)));
        const CellsAlongRay boxes(cells);
        const auto resolution = static_cast<double>(cells.resolution());
        Evaluator::Workspace w;
        for (int i = 0; i < 300; ++i) {
            const Line line = line_about(mesh, rng);
            const auto expected = crossings_in_double(mesh, line, 8 * resolution);
            if (!expected) continue;
            ++lines;
            glm::vec3 p = line.origin;
            Phase phase = vacuum;
            for (const double t : *expected) {
                const auto found = nearest_crossing(boxes, p, line.direction, phase, w, counters);
                REQUIRE(found);
                ++crossings;
                const glm::dvec3 at = 0.5 * (glm::dvec3(found->p_from) + glm::dvec3(found->p_to));
                const double away = std::abs(glm::dot(at - glm::dvec3(line.origin), glm::dvec3(line.direction)) - t);
                farthest = std::max(farthest, away / resolution);
                REQUIRE(found->from == phase);
                p = found->p_to;
                phase = found->to;
            }
            CHECK_FALSE(nearest_crossing(boxes, p, line.direction, phase, w, counters));
        }
    }
    MESSAGE(lines, " rays, ", crossings, " crossings, at most ", farthest, " resolutions away; ", counters.visits,
            " visits, ", counters.batches, " batches");
    CHECK(crossings > lines / 2);
    CHECK(bad_normals == 0);
    CHECK(farthest < 1);
    // Faces answer nearly all visits.
    CHECK(counters.batches < counters.visits / 10);
}

TEST_CASE("rays that leave a mesh's surface find what marching through the whole finds") {
    Random rng(333);
    Compared all;
    for (int n = 0; n < (long_tests() ? 140 : 14); ++n) {
        const Field mesh = field_of(random_mesh(rng, 1 + n % 2, 0.5f));
        const Phased object = object_of(mesh, n % ways, rng);
        Evaluator::Workspace w;
        const InterfaceCells cells(object);
        const CellsAlongRay boxes(cells);
        const InterfaceTracer tracer(object);
        for (int i = 0; i < 150; ++i) {
            const ComparedRay ray = compared_ray(tracer, false, rng, w);
            const auto hit = tracer.first_crossing(ray.origin, ray.direction, 0, 1e6f, {}, w);
            if (!hit) continue;
            const bool is_near = rng.chance(0.5);
            const glm::vec3 normal = tracer.normal(*hit, ray.direction);
            glm::vec3 away = rng.direction();
            if ((glm::dot(away, normal) < 0) != is_near) away = -away;
            compare_ray(object, boxes, tracer, {}, {is_near ? hit->p_from : hit->p_to, away}, w, all);
        }
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.counters.batches, " batches");
    CHECK(all.rays > 500);
    CHECK(all.different == 0);
}

TEST_CASE("a normal is the triangle's, with any map to the object's space") {
    Random rng(334);
    std::size_t normals = 0;
    double worst = 0;
    for (int way = 0; way < 4; ++way) {
        const Phased object = object_of(field_of(random_mesh(rng, 2, 0.5f)), way, rng);
        const InterfaceCells cells(object);
        const InterfaceTracer tracer(object);
        const CellsAlongRay boxes(cells);
        Evaluator::Workspace w;
        for (int i = 0; i < 300; ++i) {
            const ComparedRay ray = compared_ray(tracer, false, rng, w);
            for (const auto& [enter, leave, c] : boxes.along(ray.origin, ray.direction)) {
                TraceCounters unused;
                const auto hit = cells.first_crossing(c, ray.origin, ray.direction, 0, 1e6f, vacuum, w, unused);
                if (!hit || hit->from != vacuum || hit->t_to == hit->t_from) continue;
                const CrossingNormal normal = cells.normal(c, *hit, ray.direction);
                CHECK(glm::dot(normal.unit, ray.direction) > 0);
                // By differences in double on the near side, from where the nearest piece is the face, unless the
                // differences disagree with each other.
                const double step = 0.01 * static_cast<double>(cells.resolution());
                glm::dvec3 gradient;
                for (int k = 0; k < 3; ++k) {
                    glm::dvec3 side(0);
                    side[k] = step;
                    gradient[k] = tests::values(object, glm::dvec3(hit->p_from) + side)[0] -
                                  tests::values(object, glm::dvec3(hit->p_from) - side)[0];
                }
                ++normals;
                worst = std::max(
                    worst, glm::length(glm::cross(glm::normalize(gradient), glm::dvec3(normal.unit))) > 1e-3 ? 1. : 0.);
                break;
            }
        }
    }
    MESSAGE(normals, " normals");
    CHECK(normals > 300);
    CHECK(worst == 0);
}

TEST_CASE("a ray that carries a phase in which it is not changes to its own at the start") {
    const InterfaceCells cells(solid(field_of(octahedron_mesh())));
    const CellsAlongRay boxes(cells);
    Evaluator::Workspace w;
    TraceCounters counters;
    const auto first = [&](const glm::vec3& p, const glm::vec3& d, Phase phase) {
        return nearest_crossing(boxes, p, d, phase, w, counters);
    };
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 1, 1)), on(glm::vec3(1.f / 3));
    // Away from the surface, from points far beyond rounding on either side.
    for (const float side : {1.f, -1.f}) {
        const glm::vec3 p = on + side * 100 * cells.resolution() * normal;
        const Phase here = side > 0 ? vacuum : Phase{1}, other = side > 0 ? Phase{1} : vacuum;
        for (const Phase wrong : {other, Phase{5}}) {
            const auto crossing = first(p, side * normal, wrong);
            REQUIRE(crossing);
            CHECK(crossing->from == wrong);
            CHECK(crossing->to == here);
            CHECK(crossing->t_from == 0);
            CHECK(crossing->t_to == 0);
        }
        const auto right = first(p, side * normal, here);
        CHECK(right.has_value() == (side < 0));
    }
    // Along a face, above it: the whole line meets none.
    const glm::vec3 above = on + 100 * cells.resolution() * normal, along = glm::normalize(glm::vec3(1, -1, 0));
    CHECK_FALSE(first(above, along, vacuum));
    const auto at_start = first(above, along, Phase{1});
    REQUIRE(at_start);
    CHECK(at_start->to == vacuum);
    CHECK(at_start->t_to == 0);
    // From afar: where the ray enters the first cell, before the face that it meets there.
    const auto at_entry = first({0.2f, 0.1f, 5}, {0, 0, -1}, Phase{1});
    REQUIRE(at_entry);
    CHECK(at_entry->from == Phase{1});
    CHECK(at_entry->to == vacuum);
    CHECK(at_entry->t_from == at_entry->t_to);
    CHECK(at_entry->t_from < 4.3f);
}

TEST_CASE("every instruction set meets the same faces, to the last bit") {
    Random rng(335);
    const InterfaceCells cells(solid(field_of(random_mesh(rng, 3, 0.5f))));
    std::vector<Line> lines;
    for (int i = 0; i < 300; ++i) lines.push_back({2.f * rng.direction(), rng.direction()});
    for (Line& line : lines)
        if (glm::dot(line.origin, line.direction) > 0) line.direction = -line.direction;
    const auto all = [&] {
        std::vector<float> found;
        TraceCounters counters;
        for (const Line& line : lines)
            for (std::size_t c = 0; c < cells.size(); ++c) {
                const auto hit = cells.first_crossing(c, TracedRay(line.origin, line.direction), 0, 100, vacuum,
                                                      std::nullopt, counters);
                if (!hit) continue;
                const glm::vec3 n = cells.normal(c, *hit, line.direction).unit;
                found.insert(found.end(), {static_cast<float>(c), hit->t_from, hit->t_to, hit->p_from.x, hit->p_to.z,
                                           n.x, n.y, n.z});
            }
        return found;
    };
    const std::string usual = simd_target();
    const std::vector<float> expected = all();
    CHECK(expected.size() > 8 * 50);
    for (const std::string& name : simd_targets()) {
        CAPTURE(name);
        use_simd_target(name);
        CHECK(all() == expected);
    }
    use_simd_target(usual);
}

TEST_CASE("faces are in files of cells, and damaged tables of them are found") {
    using cells::CellsFile, cells::CellTables, cells::describe_damage;
    Random rng(336);
    const Phased object = solid(field_of(random_mesh(rng, 3, 0.5f)));
    const InterfaceCells built(object);
    const support::TemporaryDirectory folder;
    const fs::path path = fs::path(folder.path()) / "mesh";
    write_cells(path, built);
    const auto read = read_cells(path, object, {});
    const auto [tables, program, settings] = CellsFile::contents(built);
    const CellTables& again = CellsFile::contents(*read).tables;
    REQUIRE(tables.faces.size() > 8);
    REQUIRE(again.faces.size() == tables.faces.size());
    CHECK(std::memcmp(again.faces.data(), tables.faces.data(), tables.faces.size() * sizeof(tables.faces[0])) == 0);
    CHECK(again.first_faces == tables.first_faces);
    CHECK(describe_damage(tables, program).empty());
    const auto is_found = [&](auto&& damage) {
        CellTables damaged = tables;
        damage(damaged);
        return !describe_damage(damaged, program).empty();
    };
    CHECK(is_found([](CellTables& t) { t.first_faces.back() += 1; }));
    CHECK(is_found([](CellTables& t) { t.first_faces.front() = 1; }));
    CHECK(is_found([](CellTables& t) { t.first_faces.pop_back(); }));
    CHECK(is_found([](CellTables& t) { t.first_faces.clear(); }));
    CHECK(is_found([](CellTables& t) { std::swap(t.first_faces[1], t.first_faces[3]); }));
    // More faces in one cell than a search has room for.
    CHECK(is_found([](CellTables& t) {
        t.faces.resize(t.faces.size() + 100);
        t.first_faces.back() += 100;
    }));
}

}  // namespace test_mesh_faces
