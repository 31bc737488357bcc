// Sphere carving: no point of the solid lies outside the carved planes, for any tree, phase and amount of work. For
// solids with a known hull, the carved volume is close to the hull's.
#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/carving/carve.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/octahedron.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/thin_shell.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace test_carving {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr double pi = 3.141592653589793;

// The number of points of the solid that lie outside the carved bounds: among random points in a box, and among points
// that random rays find on its surface.
struct Outside {
    std::size_t points = 0, outside = 0;
};
Outside points_outside(const Phased& object, PhaseSet of, const CarvedBounds& carved, Random& rng, int samples) {
    Outside found;
    const auto look = [&](const glm::dvec3& p) {
        ++found.points;
        found.outside += !carved.contains(p);
    };
    const InterfaceTracer tracer(object);
    Evaluator::Workspace workspace;
    const Bounds region = tracer.bounds();
    const auto is_of = [&](Phase phase) { return of.empty() ? phase != vacuum : of.contains(phase); };
    for (int i = 0; i < samples; ++i) {
        const glm::vec3 p = rng.in(region);
        if (is_of(tracer.label(p, workspace))) look(glm::dvec3(p));
    }
    for (int i = 0; i < samples / 8; ++i) {
        const glm::vec3 direction = rng.direction();
        const glm::vec3 origin = rng.in(region)-direction * (0.7f * region.diagonal());
        std::optional<Phase> phase;
        float t = 0;
        for (int n = 0; n < 20; ++n) {
            const auto crossing = tracer.first_crossing(origin, direction, t, 3 * region.diagonal(), phase, workspace);
            if (!crossing) break;
            if (is_of(crossing->from)) look(glm::dvec3(crossing->p_from));
            if (is_of(crossing->to)) look(glm::dvec3(crossing->p_to));
            phase = crossing->to;
            t = crossing->t_to;
        }
    }
    return found;
}

CarvedBounds moved_inward(CarvedBounds carved, double by) {
    for (HalfSpace& plane : carved.planes) plane.offset -= by;
    return carved;
}

}  // namespace

TEST_CASE("no point of any phase of any tree lies outside, however little work there is") {
    Random rng(11);
    std::size_t points = 0, objects = 0, planted = 0;
    while (objects < 24) {
        const Phased object = random_object(rng, 4);
        const Bounds b = bounds(object);
        if (!b.finite() || b.empty() || b.diagonal() < 0.1f) continue;
        if (phases(object).bits == 1) continue;  // only the vacuum is left, which cannot be carved
        ++objects;
        std::vector<PhaseSet> sets{{}};
        for_each_phase(phases(object).bits & ~std::uint64_t{1},
                       [&](int i) { sets.push_back(PhaseSet::of(Phase{static_cast<std::uint8_t>(i)})); });
        for (const PhaseSet of : sets) {
            CarveOptions options;
            options.max_evaluations = rng.chance(0.5) ? 300 : 6000;
            options.max_planes = 6 + rng.below(20);
            const CarvedBounds carved = carve(object, of, options);
            CHECK(carved.evaluations <= options.max_evaluations + 200);
            const Outside found = points_outside(object, of, carved, rng, 1500);
            points += found.points;
            CHECK(found.outside == 0);
            // The test can fail: it detects planes that are a hundredth too near.
            const double inward = 0.01 * static_cast<double>(b.diagonal());
            planted += points_outside(object, of, moved_inward(carved, inward), rng, 1500).outside > 0;
        }
    }
    CHECK(points > 10'000);
    CHECK(planted > 10);
}

TEST_CASE("volumes are near those of known convex hulls") {
    struct Known {
        const char* name;
        Field field;
        double hull, allowed;  // ratio of the carved volume to the hull's
    };
    const Field turned = warped(Rotate{.axis = {1, 2, 3}, .angle = 50}, Field(Box{.size = {2, 0.3f, 0.2f}}));
    const Field pair = Union{.of = {warped(Translate{{-1, 0, 0}}, Field(Sphere{.radius = 0.5f})),
                                    warped(Translate{{1, 0, 0}}, Field(Sphere{.radius = 0.5f}))}};
    const std::vector<Known> all{
        {"a box", Box{.size = {1, 2, 3}}, 6, 1.01},
        {"a turned box", turned, 0.12, 1.05},
        {"an octahedron", Octahedron{.radius = 1}, 4.0 / 3, 1.05},
        {"a ball", Sphere{.radius = 1}, 4 * pi / 3, 1.15},
        {"a cylinder", Cylinder{.radius = 0.5f, .height = 2}, pi / 2, 1.12},
        {"two balls", pair, 2 * pi * 0.25 + pi / 6, 1.15},
        // The hull of a ring is a rounded disk. By Pappus, its volume is that of the outer half of the tube, plus the
        // part in between.
        {"a ring", Torus{.major = 1, .minor = 0.25f},
         pi * 0.5 + pi * pi * 0.25 * 0.25 + 4 * pi / 3 * 0.25 * 0.25 * 0.25, 1.15},
    };
    for (const Known& known : all) {
        CAPTURE(known.name);
        const CarvedBounds carved = carve(known.field);
        CHECK(carved.volume >= known.hull * 0.9999);
        CHECK(carved.volume <= known.hull * known.allowed);
        CHECK(carved.is_within_tolerance);
    }
    // A diagonal stick fills little of its box.
    const CarvedBounds stick = carve(turned);
    const glm::vec3 extent = stick.box.extent();
    CHECK(stick.volume < 0.2 * static_cast<double>(extent.x * extent.y * extent.z));
}

TEST_CASE("a phase alone is bounded more closely than the whole") {
    const Phased shell =
        ThinShell{.of = Sphere{.radius = 1}, .shell = Phase{1}, .inside = Phase{2}, .half_thickness = 0.2f};
    const CarvedBounds whole = carve(shell), inner = carve(shell, PhaseSet::of(Phase{2}));
    CHECK(whole.box.high.x == doctest::Approx(1.2).epsilon(0.01));
    CHECK(inner.box.high.x == doctest::Approx(0.8).epsilon(0.01));
    CHECK(inner.volume < 0.4 * whole.volume);
    CHECK_THROWS_AS(carve(shell, PhaseSet::of(vacuum)), ModelError);
    CHECK_THROWS_AS(carve(shell, PhaseSet::of(Phase{3})), ModelError);
}

TEST_CASE("given directions make a k-DOP, and the clip of a ray is what of it is inside") {
    CarveOptions options;
    for (int x = -1; x <= 1; x += 2)
        for (int y = -1; y <= 1; y += 2)
            for (int z = -1; z <= 1; z += 2) options.directions.emplace_back(x, y, z);
    const CarvedBounds carved = carve(Field(Octahedron{.radius = 1}), options);
    CHECK(carved.volume == doctest::Approx(4.0 / 3).epsilon(0.01));
    // Eight sides, and the box's six, which take a little off the corners.
    CHECK(carved.planes.size() == 14);
    CHECK(carved.mesh.faces.size() == 14);
    CHECK(carved.mesh.corners.size() == 24);
    CHECK(carved.mesh.edges().size() == 36);

    Random rng(7);
    const Field as_node = as_field(carved);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 origin(rng.in(Bounds::centred(glm::vec3(3)))), d(rng.direction());
        double near = 0, far = 10;
        carved.clip(origin, d, near, far);
        for (int k = 0; k <= 50; ++k) {
            const double t = 0.2 * k;
            const glm::dvec3 p = origin + d * t;
            if (std::abs(t - near) < 1e-9 || std::abs(t - far) < 1e-9) continue;
            CHECK(carved.contains(p) == (near < t && t < far));
            if (carved.contains(p)) CHECK(distance(as_node, glm::vec3(p)) <= 0);
        }
    }
}

TEST_CASE("what has no bounds is rejected, what is empty has none, and work can be ended") {
    CHECK_THROWS_AS(carve(Field(Plane{})), ModelError);
    const Field nothing = Difference{.from = Sphere{.radius = 1}, .subtract = {Sphere{.radius = 1.5f}}};
    const CarvedBounds none = carve(nothing);
    CHECK(none.box.empty());
    CHECK(!none.contains(glm::dvec3(0)));
    CarveOptions options;
    options.cancelled = [] { return true; };
    CHECK_THROWS_AS(carve(Field(Sphere{}), options), CarvingCancelled);
    options = {};
    options.max_planes = 3;
    CHECK_THROWS_AS(carve(Field(Sphere{}), options), ModelError);
    options = {};
    options.directions = {glm::dvec3(0)};
    CHECK_THROWS_AS(carve(Field(Sphere{}), options), ModelError);
}

}  // namespace test_carving
