// Tests closing gaps between phases. The vacuum between simple shapes is checked by distances to points of their
// surfaces. A glass of water, in which the water overlaps the glass, touches it or leaves a gap, is compared with the
// exact tree.
//
// That the components are 1-Lipschitz, and that at most one is negative, is tested with all nodes in lipschitz.cpp.
#include "phasetree/nodes/phased/close_gaps.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/strata.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/glass_of_water.hpp"
#include "support/long_tests.hpp"
#include "support/random_mesh.hpp"
#include "support/random_tree.hpp"
#include "support/random_voxels.hpp"

namespace test_close_gaps {

using namespace phasetree;
using namespace phasetree::tests;
using namespace phasetree::tests::glass_of_water;

namespace {

constexpr Phase ball_phase{1}, box_phase{2}, bead_phase{3};

using Points = std::vector<glm::vec3>;

constexpr float spacing = 0.01f;  ///< of the points of a surface
const int quarter_of_points = long_tests() ? 50'000 : 15'000;
const int rays = long_tests() ? 100'000 : 25'000;

/// Points of a sphere, no more than `spacing` apart.
Points sphere_points(const glm::vec3& centre, float r) {
    Points points;
    const int rows = static_cast<int>(std::ceil(3.1415927f * r / spacing));
    for (int i = 0; i <= rows; ++i) {
        const float polar = 3.1415927f * static_cast<float>(i) / static_cast<float>(rows);
        const int columns = 1 + static_cast<int>(std::ceil(6.2831853f * r * std::sin(polar) / spacing));
        for (int k = 0; k < columns; ++k) {
            const float turn = 6.2831853f * static_cast<float>(k) / static_cast<float>(columns);
            points.push_back(centre + r * glm::vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                                    std::cos(polar)));
        }
    }
    return points;
}
/// Points of the faces of a cube, no more than `spacing` apart.
Points cube_points(const glm::vec3& centre, float side) {
    Points points;
    const int steps = static_cast<int>(std::ceil(side / spacing));
    for (int axis = 0; axis < 3; ++axis)
        for (const float face : {-0.5f, 0.5f})
            for (int i = 0; i <= steps; ++i)
                for (int k = 0; k <= steps; ++k) {
                    glm::vec3 q(0);
                    q[axis] = face;
                    q[(axis + 1) % 3] = static_cast<float>(i) / static_cast<float>(steps) - 0.5f;
                    q[(axis + 2) % 3] = static_cast<float>(k) / static_cast<float>(steps) - 0.5f;
                    points.push_back(centre + side * q);
                }
    return points;
}
float distance_to(const Points& points, const glm::vec3& p) {
    float least = Bounds::infinity;
    for (const glm::vec3& q : points) least = std::min(least, glm::dot(p - q, p - q));
    return std::sqrt(least);
}

Field at(const glm::vec3& place, const Field& f) {
    return warped(Translate{place}, f);
}

template <class Node>
std::string error(Node node) {
    try {
        (void)Phased(std::move(node));
    } catch (const ModelError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE(
    "a gap is where the distances to two surfaces add up to less than it, and belongs to the phase listed first") {
    // All three shapes are near each other at the origin. The bead overlaps the cube.
    const glm::vec3 ball_at(-0.52f, 0, 0), cube_at(0.44f, 0, 0), bead_at(0.02f, 0, 0.3f);
    const float ball_radius = 0.5f, cube_side = 0.8f, bead_radius = 0.2f, g = 0.15f;
    const Phased apart = Over{.of = {Set{.phase = ball_phase, .of = at(ball_at, Sphere{.radius = ball_radius})},
                                     Set{.phase = box_phase, .of = at(cube_at, Box{.size = glm::vec3(cube_side)})},
                                     Set{.phase = bead_phase, .of = at(bead_at, Sphere{.radius = bead_radius})}}};
    const std::array<Points, 3> surfaces{sphere_points(ball_at, ball_radius), cube_points(cube_at, cube_side),
                                         sphere_points(bead_at, bead_radius)};
    for (const std::vector<Phase>& order : {std::vector{ball_phase, box_phase},
                                            {box_phase, ball_phase},
                                            {bead_phase, ball_phase, box_phase},
                                            {box_phase, bead_phase, ball_phase}}) {
        const Phased object = CloseGaps{.of = apart, .of_phases = order, .gap = g};
        Random rng(701);
        std::array<int, 4> filled{};
        int compared = 0;
        for (int n = 0; n < 2000; ++n) {
            const glm::vec3 p = rng.in(Bounds::centred({0.15f, 0.35f, 0.4f}));
            const Phase before = label(distances(apart, p)), after = label(distances(object, p));
            if (before != vacuum) {
                REQUIRE(after == before);
                continue;
            }
            std::array<float, 4> distance{};
            for (const Phase k : order) distance[k.index] = distance_to(surfaces[k.index - 1u], p);
            Phase expected = vacuum;
            bool is_certain = true;
            for (std::size_t i = order.size(); i-- > 0;)
                for (std::size_t k = i + 1; k < order.size(); ++k) {
                    const float sum = distance[order[i].index] + distance[order[k].index];
                    if (sum < g) expected = order[i];
                    // The nearest point of the surface is no more than 0.71 spacings from one of its points.
                    is_certain = is_certain && !(sum >= g && sum < g + 1.5f * spacing);
                }
            if (!is_certain) continue;
            ++compared;
            ++filled[expected.index];
            CAPTURE(p.x);
            CAPTURE(p.y);
            CAPTURE(p.z);
            REQUIRE(after == expected);
        }
        CHECK(compared > 500);
        CHECK(filled[vacuum.index] > 100);
        for (std::size_t i = 0; i + 1 < order.size(); ++i) CHECK(filled[order[i].index] > 20);
        CHECK(filled[order.back().index] == 0);
    }
}

namespace {

struct Differences {
    int points = 0;
    int far = 0;    ///< farther than the gap from where glass, water and vacuum meet
    int other = 0;  ///< nearer, but not water instead of vacuum
    int near = 0;   ///< nearer, water instead of vacuum
};

/// Compares the labels of an object with those of the exact glass of water, at points around its walls and everywhere.
Differences differences(const Phased& object) {
    const Phased truth = exact();
    Random rng(702);
    Differences result;
    for (int n = 0; n < 4 * quarter_of_points; ++n) {
        glm::vec3 p = rng.in(Bounds{{-0.5f, -0.5f, -0.2f}, {0.5f, 0.5f, 1}});
        if (n % 4 == 1) p *= glm::vec3(glm::vec2((radius + rng.uniform(-gap, gap)) / std::hypot(p.x, p.y)), 1);
        if (n % 4 == 2) p.z = rng.uniform(-gap, gap);
        if (n % 4 == 3) {
            const glm::vec3 around = rng.uniform(0, 1.5f * gap) * rng.direction();
            p = p * glm::vec3(glm::vec2(radius / std::hypot(p.x, p.y)), 0) + glm::vec3(0, 0, level) + around;
        }
        const Phases<float> expected = distances(truth, p);
        std::array<float, 3> sorted{expected[0], expected[1], expected[2]};
        std::sort(sorted.begin(), sorted.end());
        if (sorted[1] < 2e-6f) continue;  // rounding decides
        ++result.points;
        const Phase was = label(expected), is = label(distances(object, p));
        if (is == was) continue;
        if (distance_to_rim_of_water(p) >= gap)
            ++result.far;
        else if (was == vacuum && is == water)
            ++result.near;
        else
            ++result.other;
    }
    return result;
}

}  // namespace

TEST_CASE(
    "water that overlaps the glass, touches it, or leaves a gap has the same labels, but within a gap of its rim") {
    for (const float larger_by : {excess, 0.f, -excess}) {
        CAPTURE(larger_by);
        const Differences found = differences(closed(filled(hollow(), water_larger_by(larger_by))));
        MESSAGE(found.near, " of ", found.points, " points differ");
        CHECK(found.points > 3.8 * quarter_of_points);
        CHECK(found.far == 0);
        CHECK(found.other == 0);
        CHECK(found.near > quarter_of_points / 500);
    }
    // The node changes nothing else: without it, only water that is too small differs.
    CHECK(differences(filled(hollow(), water_larger_by(excess))).far == 0);
    CHECK(differences(filled(hollow(), water_larger_by(-excess))).far > quarter_of_points / 50);
    CHECK(differences(exact()).near == 0);
}

TEST_CASE("no component is zero in a gap that was closed, so nothing there makes rays take small steps") {
    const Phased object = closed(filled(hollow(), water_larger_by(-excess)));
    Random rng(703);
    for (int n = 0; n < 10'000; ++n) {
        const float angle = rng.uniform(0, 6.2831853f), to_glass = rng.uniform(0, 3 * excess), r = radius - to_glass;
        const glm::vec3 p(r * std::cos(angle), r * std::sin(angle), rng.uniform(0.1f, level - 0.1f));
        const Phases<float> phi = distances(object, p);
        REQUIRE(phi[glass.index] == doctest::Approx(to_glass).epsilon(1e-5));
        // The sum of the distances of the two phases is the excess in the gap, and negative in the water.
        const float from_gap = std::min((gap - excess) / 2, to_glass);
        REQUIRE(-phi[water.index] >= from_gap - 1e-6f);
        REQUIRE(phi[0] >= (gap - excess) / 2 - 1e-6f);
    }
}

namespace {

/// The surface of a solid of revolution, a closed mesh: the profile (r, z) leads from the axis to the axis, with the
/// solid on its left. `turn` is the angle of the first vertex.
TriangleMesh lathed(const std::vector<glm::vec2>& profile, std::uint32_t segments, float turn) {
    TriangleMesh mesh;
    const auto rings = static_cast<std::uint32_t>(profile.size()) - 2;
    mesh.vertices.emplace_back(0, 0, profile.front().y);
    for (std::uint32_t ring = 1; ring <= rings; ++ring)
        for (std::uint32_t k = 0; k < segments; ++k) {
            const float angle = turn + 6.2831853f * static_cast<float>(k) / static_cast<float>(segments);
            mesh.vertices.emplace_back(profile[ring].x * std::cos(angle), profile[ring].x * std::sin(angle),
                                       profile[ring].y);
        }
    mesh.vertices.emplace_back(0, 0, profile.back().y);
    const auto vertex = [&](std::uint32_t ring, std::uint32_t k) { return 1 + ring * segments + k % segments; };
    const std::uint32_t last = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
    for (std::uint32_t k = 0; k < segments; ++k) {
        mesh.triangles.emplace_back(0, vertex(0, k + 1), vertex(0, k));
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            mesh.triangles.emplace_back(vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1));
            mesh.triangles.emplace_back(vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k));
        }
        mesh.triangles.emplace_back(last, vertex(rings - 1, k), vertex(rings - 1, k + 1));
    }
    return mesh;
}
/// The glass and the water have vertices in different places, so their walls cross each other between them.
Field mesh_of_glass() {
    const float outer = radius + wall;
    return Mesh{
        .file = held(lathed({{0, -wall}, {outer, -wall}, {outer, rim}, {radius, rim}, {radius, 0}, {0, 0}}, 26, 0))};
}
Field mesh_of_water() {
    return Mesh{.file = held(lathed({{0, 0}, {radius, 0}, {radius, level}, {0, level}}, 31, 0.1f))};
}
/// Voxels of 2 cm, three of them across the wall.
Field voxels_of_glass() {
    const VoxelLattice lattice{{42, 42, 52}, {-0.41, -0.41, -0.11}, glm::dvec3(0.02)};
    return Volume{.file = held_content(sampled_grid(lattice, [](const glm::dvec3& p) {
                      return static_cast<double>(distance(hollow(), glm::vec3(p)));
                  }))};
}

struct Slivers {
    int wetted = 0;   ///< crossings between glass and water
    int slivers = 0;  ///< crossings from glass or water into vacuum where the exact object has none
};

/// Follow rays that start within the water or outside the glass, and pass through everything.
Slivers slivers(const Phased& object, int rays) {
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    Random rng(704);
    Slivers result;
    for (int n = 0; n < rays; ++n) {
        const glm::vec3 target = rng.in(Bounds{{-0.3f, -0.3f, -0.01f}, {0.3f, 0.3f, level - 2 * gap}});
        const glm::vec3 d = rng.direction();
        glm::vec3 origin = n % 2 == 0 ? target - 2.f * d : glm::vec3(0, 0, 0.2f) + 0.1f * rng.direction();
        Phase phase = tracer.label(origin, w);
        for (int k = 0; k < 100; ++k) {
            const auto crossing = tracer.first_crossing(origin, d, 0, 4, phase, w);
            if (!crossing) break;
            const glm::vec3& p = crossing->p_to;
            // Above the surface of the water less the gap, and outside the middle of the wall, there is vacuum.
            const bool is_wet = p.z < level - gap && p.z > -0.5f * wall && std::hypot(p.x, p.y) < radius + 0.5f * wall;
            result.slivers += is_wet && crossing->to == vacuum;
            result.wetted += crossing->from != vacuum && crossing->to != vacuum;
            origin = p;
            phase = crossing->to;
        }
    }
    return result;
}

}  // namespace

TEST_CASE("no ray meets vacuum between glass and water, whether they overlap, touch, or leave a gap") {
    for (const float larger_by : {excess, 0.f, -excess}) {
        CAPTURE(larger_by);
        const Phased apart = filled(hollow(), water_larger_by(larger_by));
        const Slivers before = slivers(apart, rays / 3), after = slivers(closed(apart), rays);
        MESSAGE(before.slivers, " slivers before, in a third as many rays; ", after.wetted,
                " crossings from glass to water or back");
        CHECK(after.slivers == 0);
        CHECK(after.wetted > rays);
        if (larger_by < 0) CHECK(before.slivers > rays / 10);
        // Where the walls coincide, few rays meet the slivers that rounding leaves between them.
        if (larger_by == 0) CHECK(before.slivers > 0);
    }
}

TEST_CASE("no ray meets vacuum between meshes or voxels of glass and water, though their surfaces differ") {
    const std::array objects{filled(mesh_of_glass(), mesh_of_water()), filled(voxels_of_glass(), mesh_of_water())};
    for (std::size_t i = 0; i < objects.size(); ++i) {
        CAPTURE(i);
        const Slivers before = slivers(objects[i], 1000), after = slivers(closed(objects[i]), rays);
        MESSAGE(before.slivers, " slivers in 1000 rays before; ", after.wetted,
                " crossings from glass to water or back");
        CHECK(after.slivers == 0);
        CHECK(after.wetted > rays);
        CHECK(before.slivers > 10);
    }
}

TEST_CASE("an object without vacuum has no gaps") {
    const Phased object = Strata{.of_phases = {water, glass}, .thicknesses = {1}};
    const Phased same = CloseGaps{.of = object, .of_phases = {water, glass}, .gap = 1};
    for (const float z : {-2.f, -0.3f, 0.4f, 1.7f})
        for (const Phase k : {water, glass})
            CHECK(distances(object, {0, 0, z})[k.index] == distances(same, {0, 0, z})[k.index]);
}

TEST_CASE("the gap is bounded by half of it beyond the object") {
    // Two cubes side by side; the ridge over the gap between them is highest if they touch.
    const Phased cubes = Over{.of = {Set{.phase = water, .of = at({-0.5f, 0, 0}, Box{.size = glm::vec3(1)})},
                                     Set{.phase = glass, .of = at({0.5f, 0, 0}, Box{.size = glm::vec3(1)})}}};
    const Phased object = CloseGaps{.of = cubes, .of_phases = {water, glass}, .gap = 0.2f};
    CHECK(label(distances(object, {0, 0, 0.599f})) == water);
    CHECK(label(distances(object, {0, 0, 0.601f})) == vacuum);
    CHECK(bounds(object).high.z == doctest::Approx(0.6f));
}

TEST_CASE("close_gaps rejects phases that it cannot use") {
    const Phased object = exact();
    CHECK(error(CloseGaps{.of = object, .of_phases = {water}, .gap = gap}) ==
          "close_gaps: \"phases\" must list at least two phases");
    CHECK(error(CloseGaps{.of = object, .of_phases = {water, Phase{3}}, .gap = gap}) ==
          "close_gaps: item 2 of \"phases\" is not a phase of the object");
    CHECK(error(CloseGaps{.of = object, .of_phases = {water, glass, water}, .gap = gap}) ==
          "close_gaps: item 3 of \"phases\" is listed twice");
    CHECK(error(CloseGaps{.of = object, .of_phases = {water, glass}, .gap = 0}) ==
          "close_gaps: \"gap\" must be positive, but is 0");
}

}  // namespace test_close_gaps
