// Meshes of phases: they are closed manifolds with sharp edges, right positions and volumes, and shared triangles where
// phases touch.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "phasetree/meshing/phase_mesh.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/slab.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/thin_shell.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/long_tests.hpp"
#include "support/manifold.hpp"
#include "support/random_voxel_lines.hpp"

namespace test_meshing {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

const Phase one{1}, two{2};

Phased of(Phase phase, const Field& field) {
    return Set{.phase = phase, .of = field};
}

PhaseMesh meshed(const Phased& object, float spacing) {
    const InterfaceTracer tracer(object);
    return mesh_of(tracer.bounds(), line_tracer(tracer), {.spacing = spacing});
}

// Formats that identify vertices by their positions alone join vertices at equal positions.
std::size_t vertices_in_one_place(std::vector<glm::vec3> vertices) {
    std::ranges::sort(vertices, {}, [](const glm::vec3& v) { return std::tuple(v.x, v.y, v.z); });
    return static_cast<std::size_t>(vertices.end() - std::unique(vertices.begin(), vertices.end()));
}

std::size_t faults_of(const PhaseMesh& mesh, PhaseSet phases) {
    const ClosedMesh closed = surface_of(mesh, phases);
    return manifold_faults(closed.triangles, closed.vertices.size()).all() + vertices_in_one_place(closed.vertices);
}

// The number of triangles whose normal deviates by more than 26° from the direction in which the field decreases.
std::size_t turned_away(const ClosedMesh& mesh, const Field& field) {
    const Evaluator evaluator(record(of(one, field)));
    return static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, [&](const auto& t) {
        const glm::dvec3 a(mesh.vertices[t[0]]), b(mesh.vertices[t[1]]), c(mesh.vertices[t[2]]);
        const glm::dvec3 outwards(evaluator.gradient(glm::vec3((a + b + c) / 3.0), one));
        return glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(outwards)) < 0.9;
    }));
}

double volume_of(const PhaseMesh& mesh, Phase phase) {
    return surface_of(mesh, PhaseSet::of(phase)).volume();
}

}  // namespace

TEST_CASE("the mesh of a box has its faces, its edges and its corners") {
    const Field box = Box{.size = {2, 1.5f, 1}};
    std::size_t vertices = 0, off = 0, triangles = 0, away = 0;
    for (int turn = 0; turn < 10; ++turn) {
        const Field turned = warped(Rotate{.axis = {1, 2, 3}, .angle = 13.f * static_cast<float>(turn)}, box);
        const PhaseMesh mesh = meshed(of(one, turned), 0.1f);
        const ClosedMesh closed = surface_of(mesh, PhaseSet::of(one));
        CHECK(faults_of(mesh, PhaseSet::of(one)) == 0);
        CHECK(mesh.phases() == (PhaseSet::of(vacuum) | PhaseSet::of(one)));
        CHECK(closed.volume() == doctest::Approx(3).epsilon(turn == 0 ? 1e-5 : 5e-4));
        away += turned_away(closed, turned);
        triangles += closed.triangles.size();
        for (const glm::vec3& v : closed.vertices) {
            const float d = std::abs(distance(turned, v));
            ++vertices;
            off += d > 3e-4f ? 1 : 0;
            CHECK(d < (turn == 0 ? 1e-4f : 0.1f));
        }
        for (const PhaseMesh::Triangle& t : mesh.triangles) CHECK(t.behind > t.front);
    }
    // Two corners that no line of the grid meets, and eight vertices along an edge of the box, where labels were
    // changed and triangles between vertices on the box would cross each other.
    CHECK(off <= 10);
    CHECK(vertices > 18'000);
    // Diagonals of quadrilaterals that are not chosen by the surface make more than 1 in 100.
    CHECK(away * 150 < triangles);
}

TEST_CASE("the mesh of a ball comes nearer with the square of the spacing") {
    for (const float spacing : {0.2f, 0.1f, 0.05f}) {
        const PhaseMesh mesh = meshed(of(one, Sphere{.radius = 1}), spacing);
        const double square = static_cast<double>(spacing * spacing);
        CHECK(faults_of(mesh, PhaseSet::of(one)) == 0);
        double farthest = 0, mean = 0;
        for (const glm::vec3& v : mesh.vertices) {
            const double off = static_cast<double>(glm::length(v)) - 1;
            farthest = std::max(farthest, std::abs(off));
            mean += off / static_cast<double>(mesh.vertices.size());
        }
        CAPTURE(spacing);
        CHECK(farthest < 0.4 * square);
        // Where faces are recognised as separate instead of one bent face, vertices are on the surface.
        if (spacing <= 0.1f) CHECK(std::abs(mean) < 0.001 * square);
        CHECK(std::abs(volume_of(mesh, one) / (4 * std::numbers::pi / 3) - 1) < 0.5 * square);
    }
}

TEST_CASE("phases that touch share their triangles, and where three meet all have the same vertices") {
    // Half a ball below a block.
    const Field half = warped(Translate{{0, 0, 1.5f}}, Field(Box{.size = {3, 3, 3}}));
    const Phased object = Over{{of(two, half), of(one, Sphere{.radius = 1})}};
    for (const float spacing : {0.11f, 0.055f}) {
        CAPTURE(spacing);
        const PhaseMesh mesh = meshed(object, spacing);
        for (const Phase phase : {vacuum, one, two}) CHECK(faults_of(mesh, PhaseSet::of(phase)) == 0);
        CHECK(faults_of(mesh, PhaseSet::of(one) | PhaseSet::of(two)) == 0);
        CHECK(volume_of(mesh, one) == doctest::Approx(2 * std::numbers::pi / 3).epsilon(0.01));
        CHECK(volume_of(mesh, two) == doctest::Approx(27).epsilon(1e-3));
        // Together they have the same volume as separately, up to rounding: there is no gap and no overlap.
        CHECK(surface_of(mesh, PhaseSet::of(one) | PhaseSet::of(two)).volume() ==
              doctest::Approx(volume_of(mesh, one) + volume_of(mesh, two)).epsilon(1e-9));
        // The circle where the three meet.
        std::vector<std::uint64_t> sides(mesh.vertices.size(), 0);
        for (const PhaseMesh::Triangle& t : mesh.triangles)
            for (const std::uint32_t v : t.vertices)
                sides[v] |= std::uint64_t{1} << t.behind.index | std::uint64_t{1} << t.front.index;
        int on_circle = 0;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            if (sides[i] != 7) continue;
            ++on_circle;
            CHECK(std::abs(mesh.vertices[i].z) < 2 * spacing * spacing);
            CHECK(std::abs(glm::length(mesh.vertices[i]) - 1) < 2 * spacing * spacing);
        }
        CHECK(on_circle > 40);
    }
}

TEST_CASE("each phase is a manifold, however its points are mixed") {
    std::size_t triangles = 0;
    for (std::uint64_t seed = 0; seed < (long_tests() ? 40u : 15u); ++seed) {
        const int phases = 2 + static_cast<int>(seed % 5);
        const RandomVoxels voxels{0.1 + 0.02 * static_cast<double>(seed % 4), phases, seed};
        const PhaseMesh mesh = mesh_of(Bounds::centred(glm::vec3(1)), voxels.lines(), {.spacing = 0.1f});
        triangles += mesh.triangles.size();
        CAPTURE(seed);
        for (int p = 0; p < phases; ++p) CHECK(faults_of(mesh, PhaseSet::of(Phase{static_cast<std::uint8_t>(p)})) == 0);
    }
    CHECK(triangles > (long_tests() ? 100'000 : 35'000));
}

TEST_CASE("random objects have meshes of manifolds whose volumes are theirs") {
    int objects = 0;
    for (std::uint64_t seed = 1; objects < (long_tests() ? 25 : 10); ++seed) {
        REQUIRE(seed < 400);
        Random rng(seed);
        const Phased object = random_object(rng, 3);
        std::optional<InterfaceTracer> tracer;
        try {
            tracer.emplace(object);
        } catch (const ModelError&) {
            continue;
        }
        const Bounds bounds = tracer->bounds();
        const PhaseMesh mesh = mesh_of(bounds, line_tracer(*tracer), {.spacing = bounds.diagonal() / 64});
        ++objects;
        CAPTURE(seed);
        for_each_phase(mesh.phases().bits, [&](int p) {
            CAPTURE(p);
            CHECK(faults_of(mesh, PhaseSet::of(Phase{static_cast<std::uint8_t>(p)})) == 0);
        });
        // Counted at points of a lattice other than the mesh's. Interfaces may be off by a cube of either.
        Evaluator::Workspace workspace;
        const glm::dvec3 size(bounds.extent());
        constexpr int n = 40;
        std::array<double, Phase::capacity> inside{}, unsure{};
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const glm::vec3 p =
                        bounds.low + glm::vec3(size * (glm::dvec3(i, j, k) + 0.5) / static_cast<double>(n));
                    const Phases<float> phi = tracer->evaluator().distances(p, workspace);
                    inside[tracer->label(p, workspace).index] += 1;
                    for_each_phase(phi.present, [&](int q) {
                        if (std::abs(phi[q]) < bounds.diagonal() / 40) unsure[static_cast<std::size_t>(q)] += 1;
                    });
                }
        const double share = size.x * size.y * size.z / (n * n * n);
        for_each_phase(phases(object).bits & ~std::uint64_t{1}, [&](int p) {
            const auto i = static_cast<std::size_t>(p);
            const double volume = volume_of(mesh, Phase{static_cast<std::uint8_t>(p)});
            CAPTURE(p);
            CHECK(std::abs(volume - inside[i] * share) <= 0.25 * unsure[i] * share + 3 * share);
        });
    }
}

TEST_CASE("a wall as thick as the grid is whole, and both of its faces are smooth") {
    const Phased wall = ThinShell{.of = Sphere{.radius = 1}, .shell = one, .inside = two, .half_thickness = 0.05f};
    const float spacing = 0.098f;
    const PhaseMesh mesh = meshed(wall, spacing);
    for (const Phase phase : {vacuum, one, two}) CHECK(faults_of(mesh, PhaseSet::of(phase)) == 0);
    for (const PhaseMesh::Triangle& t : mesh.triangles) CHECK((t.front == one || t.behind == one));
    std::size_t off = 0;
    for (const glm::vec3& v : mesh.vertices)
        off += std::abs(std::abs(glm::length(v) - 1) - 0.05f) > 0.4f * spacing * spacing ? 1 : 0;
    CHECK(off == 0);
}

TEST_CASE("triangles do not fold over where two interfaces meet at a small angle") {
    // A ball that is cut by a block little below its top.
    for (const float height : {0.9f, 0.95f}) {
        const Field block = warped(Translate{{0.013f, 0.007f, height + 0.5f}}, Field(Box{.size = {3, 3, 1}}));
        const PhaseMesh mesh = meshed(Over{{of(two, block), of(one, Sphere{.radius = 1})}}, 0.025f);
        std::size_t between = 0, folded = 0;
        double area = 0;
        for (const PhaseMesh::Triangle& t : mesh.triangles) {
            if (t.behind != two || t.front != one) continue;
            const glm::dvec3 a(mesh.vertices[t.vertices[0]]), b(mesh.vertices[t.vertices[1]]),
                c(mesh.vertices[t.vertices[2]]);
            const double down = -0.5 * glm::cross(b - a, c - a).z;
            ++between;
            folded += down < 0 ? 1 : 0;
            area += down;
        }
        CHECK(between > 1000);
        CHECK(folded == 0);
        // The rim is a wedge that is thinner than the grid.
        const auto h = static_cast<double>(height);
        CHECK(area == doctest::Approx(std::numbers::pi * (1 - h * h)).epsilon(0.15));
    }
}

TEST_CASE("a plate and a slit 1.2 times as thick as the grid are whole, however they are turned") {
    const float spacing = 0.08f, thickness = 1.2f * spacing;
    Random rng(2);
    std::size_t vertices = 0, off = 0;
    for (int i = 0; i < 12; ++i) {
        CAPTURE(i);
        const glm::vec3 normal = i == 0 ? glm::vec3(1, 1, 0) : i == 1 ? glm::vec3(1, 1, 1) : rng.direction();
        const glm::vec3 unit = glm::normalize(normal);
        const float at = rng.uniform(-0.3f, 0.3f);
        const Field ball = Sphere{.radius = 1};
        const Field plate = Slab{.normal = normal, .offset = at, .thickness = thickness};
        const double expected = std::numbers::pi * static_cast<double>(thickness) *
                                (1 - static_cast<double>(at * at + thickness * thickness / 12));
        const PhaseMesh of_plate = meshed(of(one, Intersection{.of = {ball, plate}}), spacing);
        const PhaseMesh of_slit = meshed(of(one, Difference{.from = ball, .subtract = {plate}}), spacing);
        CHECK(volume_of(of_plate, one) == doctest::Approx(expected).epsilon(0.03));
        CHECK(4 * std::numbers::pi / 3 - volume_of(of_slit, one) == doctest::Approx(expected).epsilon(0.08));
        for (const PhaseMesh& mesh : {of_plate, of_slit}) {
            CHECK(faults_of(mesh, PhaseSet::of(one)) == 0);
            // All vertices well within the ball are on the plate's faces.
            vertices += mesh.vertices.size();
            for (const glm::vec3& v : mesh.vertices) {
                const float from_face = std::abs(std::abs(glm::dot(v, unit) - at) - thickness / 2);
                off += glm::length(v) < 0.85f && from_face > 0.01f * spacing ? 1 : 0;
            }
        }
    }
    // A few are at the rims, where plate and ball meet at a small angle.
    CHECK(off * 2000 < vertices);
}

// Vertices of thin parts may lie outside their cubes, on the other side of the part.
TEST_CASE("parts smaller than the grid spacing are not turned inside out") {
    Random rng(11);
    std::size_t parts = 0, turned = 0, faults = 0;
    for (int i = 0; i < 1500; ++i) {
        const Field ball = Sphere{.radius = rng.uniform(0.4f, 1.3f)};
        const Field disc =
            Intersection{.of = {ball, Slab{.normal = rng.direction(), .thickness = rng.uniform(0.1f, 0.6f)}}};
        const Phased object = of(one, warped(Translate{rng.in({glm::vec3(-1), glm::vec3(1)})}, disc));
        const InterfaceTracer tracer(object);
        // The grid belongs to a larger box, so that discs lie anywhere relative to its cubes.
        const PhaseMesh mesh = mesh_of({glm::vec3(-4), glm::vec3(4)}, line_tracer(tracer), {.spacing = 1});
        if (mesh.triangles.empty()) continue;
        ++parts;
        turned += !(volume_of(mesh, one) > 0);
        faults += faults_of(mesh, PhaseSet::of(one));
    }
    MESSAGE(parts, " parts, ", turned, " turned inside out");
    CHECK(parts > 300);
    CHECK(turned == 0);
    CHECK(faults == 0);
}

TEST_CASE("what is thinner than the grid is counted") {
    const Phased shell = ThinShell{.of = Sphere{.radius = 1}, .shell = one, .inside = two, .half_thickness = 0.01f};
    const PhaseMesh coarse = meshed(shell, 0.1f), fine = meshed(of(one, Sphere{.radius = 1}), 0.1f);
    CHECK(coarse.skipped > coarse.crossings / 4);
    CHECK(fine.skipped < fine.crossings / 50);
    for (const Phase phase : {vacuum, one, two}) CHECK(faults_of(coarse, PhaseSet::of(phase)) == 0);
}

TEST_CASE("far from the origin vertices keep apart, and a spacing that is too fine for floats is rejected") {
    const Field box = warped(Rotate{.axis = {1, 2, 3}, .angle = 40}, Field(Box{.size = {1, 1, 1}}));
    const PhaseMesh mesh = meshed(of(one, warped(Translate{{1000, 700, -300}}, box)), 0.006f);
    CHECK(faults_of(mesh, PhaseSet::of(one)) == 0);
    CHECK(volume_of(mesh, one) == doctest::Approx(1).epsilon(0.01));
    const Phased farther = of(one, warped(Translate{{10'000, 7000, -3000}}, box));
    CHECK_THROWS_WITH_AS(meshed(farther, 0.006f), doctest::Contains("finer than 32-bit coordinates allow"), ModelError);
    CHECK(meshed(farther, 0).spacing > 0.015f);
}

TEST_CASE("a mesh does not depend on the number of threads") {
    const Phased object = Over{{of(two, Box{.size = glm::vec3(1)}), of(one, Sphere{.radius = 0.7f})}};
    const PhaseMesh many = meshed(object, 0.03f);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const PhaseMesh single = meshed(object, 0.03f);
    CHECK(many.vertices == single.vertices);
    REQUIRE(many.triangles.size() == single.triangles.size());
    for (std::size_t i = 0; i < many.triangles.size(); ++i) {
        REQUIRE(many.triangles[i].vertices == single.triangles[i].vertices);
        REQUIRE(many.triangles[i].front == single.triangles[i].front);
        REQUIRE(many.triangles[i].behind == single.triangles[i].behind);
    }
}

TEST_CASE("what has no mesh is rejected, and a mesh can be cancelled") {
    const LineTracer nothing = [](const glm::vec3&, const glm::vec3&, float, std::vector<CrossingOnLine>&) {};
    CHECK_THROWS_WITH_AS(mesh_of(Bounds::everything(), nothing), doctest::Contains("unbounded"), ModelError);
    for (const float none : {-1.f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
        CHECK_THROWS_WITH_AS(mesh_of(Bounds::centred(glm::vec3(1)), nothing, {.spacing = none}),
                             doctest::Contains("must be a positive length"), ModelError);
    CHECK_THROWS_WITH_AS(mesh_of(Bounds{}, nothing), doctest::Contains("empty"), ModelError);
    CHECK_THROWS_WITH_AS(mesh_of(Bounds::centred(glm::vec3(1)), nothing, {.spacing = 0.001f}),
                         doctest::Contains("more than 1024 cubes"), ModelError);
    CHECK_THROWS_WITH_AS(mesh_of(Bounds::centred(glm::vec3(1)), nothing, {.spacing = 0.001f}),
                         doctest::Contains("use at least 0.001953"), ModelError);
    CHECK(mesh_of(Bounds::centred(glm::vec3(1)), nothing).triangles.empty());
    CHECK_THROWS_AS(mesh_of(Bounds::centred(glm::vec3(1)), nothing, {.cancelled = [] { return true; }}),
                    MeshingCancelled);
    float last = 0;
    mesh_of(Bounds::centred(glm::vec3(1)), nothing, {.spacing = 0.1f, .progress = [&](float share) {
                                                         CHECK(share > last);
                                                         last = share;
                                                     }});
    CHECK(last == 1);
}

}  // namespace test_meshing
