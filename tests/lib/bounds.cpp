// Bounds contain everything that is not vacuum, and are infinite where the field is unbounded.
#include <doctest/doctest.h>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/polar_array.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/merge.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/rounded_box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/profiles/extrude.hpp"
#include "phasetree/nodes/profiles/rectangle.hpp"
#include "phasetree/nodes/warps/mirror.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_bounds {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// A point about the box, near it or far away, also far along one axis.
glm::vec3 probe(Random& rng, const Bounds& b) {
    const Bounds region = region_of_interest(b);
    glm::vec3 p = rng.in(region.inflated(rng.chance(0.5) ? 0.f : region.diagonal()));
    if (rng.chance(0.2)) p *= std::exp2(rng.uniform(0, 10));
    if (rng.chance(0.1)) p[rng.below(3)] *= 1000;
    // A box that is too small fails just outside a face.
    if (rng.chance(0.3) && b.finite()) {
        const int axis = rng.below(3);
        const float beyond = b.diagonal() * std::exp2(rng.uniform(-14, -2));
        p[axis] = rng.chance(0.5) ? b.high[axis] + beyond : b.low[axis] - beyond;
    }
    return p;
}

double slack(const glm::vec3& p) {
    return 1e-5 * (1 + static_cast<double>(glm::length(p)));
}

}  // namespace

TEST_CASE("nothing of an object lies outside its bounds") {
    const int trees = long_tests() ? 2000 : 24;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(61, kind);
        for (int tree = 0; tree < trees; ++tree) {
            CAPTURE(kind.name);
            CAPTURE(tree);
            const Phased object = kind.object(rng, 2 + tree % 4);
            const Bounds b = bounds(object);
            for (int n = 0; n < 100; ++n) {
                const glm::vec3 p = probe(rng, b);
                if (b.contains(p)) continue;
                const Components phi = values(object, glm::dvec3(p));
                if (phi.interface_distance() < slack(p)) continue;
                CAPTURE(p.x);
                CAPTURE(p.y);
                CAPTURE(p.z);
                REQUIRE(tests::label(object, glm::dvec3(p)) == vacuum);
            }
        }
    }
}

TEST_CASE("at every level, what is within the level of a field lies within the bounds") {
    const int trees = long_tests() ? 2000 : 24;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(62, kind);
        for (int tree = 0; tree < trees; ++tree) {
            CAPTURE(kind.name);
            CAPTURE(tree);
            const float level = rng.uniform(-0.3f, 0.6f);
            BoundsQuery query;
            const auto outside = [&](const Bounds& b, const auto& smallest) {
                for (int n = 0; n < 60; ++n) {
                    const glm::vec3 p = probe(rng, b);
                    if (b.contains(p)) continue;
                    CAPTURE(level);
                    CAPTURE(p.x);
                    CAPTURE(p.y);
                    CAPTURE(p.z);
                    REQUIRE(smallest(glm::dvec3(p)) > level - slack(p));
                }
            };
            if (kind.is_field) {
                const Field f = kind.field(rng, 1 + tree % 4);
                outside(query(f, level), [&](const glm::dvec3& p) { return value(f, p); });
            } else {
                const Phased a = kind.object(rng, 2 + tree % 4);
                outside(query(a, level), [&](const glm::dvec3& p) {
                    const Components phi = values(a, p);
                    return *std::min_element(phi.phi.begin() + 1, phi.phi.end());
                });
            }
        }
    }
}

TEST_CASE("primitives' bounds touch them") {
    // Each face has a point of the solid within a thousandth of the size, because a box that is too large slows
    // everything down.
    const auto check = [](const Field& f) {
        const Bounds b = bounds(f);
        REQUIRE(b.finite());
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool high : {false, true}) {
                double nearest = absent;
                for (int i = 0; i <= 100; ++i) {
                    for (int j = 0; j <= 100; ++j) {
                        glm::dvec3 p;
                        p[axis] = high ? b.high[axis] : b.low[axis];
                        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                        p[u] = b.low[u] + b.extent()[u] * (i / 100.0);
                        p[v] = b.low[v] + b.extent()[v] * (j / 100.0);
                        nearest = std::min(nearest, value(f, p));
                    }
                }
                CHECK(nearest < 1e-3 * b.diagonal());
            }
        }
    };
    check(Sphere{.radius = 1.3f});
    check(Box{.size = {1, 2, 3}});
    check(RoundedBox{.size = {1, 2, 3}, .radius = 0.2f});
    check(Cylinder{.radius = 0.7f, .height = 3});
    check(CappedCone{.radius_bottom = 1, .radius_top = 0.5f, .height = 2});
    check(Capsule{.from = {1, 0, 0}, .to = {0, 2, 0}, .radius = 0.5f});
    check(Torus{.major = 1, .minor = 0.25f});
}

TEST_CASE("what is unbounded has infinite bounds, what an operator cuts to size has not") {
    const Field below = Plane{};  // z < 0
    CHECK(!bounds(below).finite());
    CHECK(bounds(below).high.z == 0);
    CHECK(bounds(Field(Plane{.normal = {0, -2, 0}, .offset = 1})).low.y == -1);
    CHECK(!bounds(Field(Offset{.of = below, .amount = 1})).finite());
    CHECK(bounds(Field(Offset{.of = below, .amount = 1})).high.z == 1);
    CHECK(!bounds(Phased(Set{.phase = Phase{1}, .of = below})).finite());
    const Phased ball = Set{.phase = Phase{1}, .of = Sphere{}};
    CHECK(!bounds(Field(Merge{.of = ball, .phases = PhaseSet::of(vacuum)})).finite());
    CHECK(bounds(Field(Merge{.of = ball, .phases = {}})).finite());
    CHECK(!bounds(Phased(Under{.of = {ball, Set{.phase = Phase{2}, .of = below}}})).finite());
    const Phased cut = IntersectShape{.of = Set{.phase = Phase{2}, .of = below}, .shape = Box{}, .phases_cut = {}};
    CHECK(bounds(cut).finite());
    CHECK(bounds(cut).high.z == 0);
    CHECK(bounds(Field(Intersection{.of = {below, Sphere{}}})).finite());
    CHECK(bounds(Field(Offset{.of = Sphere{}, .amount = -2})).empty());
}

TEST_CASE("a plane that is almost parallel to an axis is unbounded along it") {
    // The normal's length rounds to 1 without the plane being level: at x = −5000 it has risen by half a metre.
    const Field f = Plane{.normal = {1e-4f, 0, 1}, .offset = 0};
    const glm::vec3 p{-5000, 0, 0.4f};
    REQUIRE(inside(f, glm::dvec3(p)));
    CHECK(bounds(f).contains(p));
    CHECK(bounds(Field(Plane{.normal = {0, -1, 3e-4f}})).contains({0, -0.1f, -5000}));
}

TEST_CASE("asking for bounds of shared subtrees takes no longer than the tree is large") {
    // Each use queries the bounds at its own level; 2²⁴ levels would take minutes.
    Field f = Sphere{};
    for (int i = 0; i < 24; ++i) f = Union{.of = {Offset{.of = f, .amount = std::ldexp(0.1f, -i)}, f}};
    const Bounds b = bounds(f);
    CHECK(b.finite());
    CHECK(b.high.x >= 1.19f);
}

TEST_CASE("a profile without end in z stays bounded in x and y when it is turned about z, mirrored or copied") {
    const Field square = Rectangle{.width = 2, .height = 2};
    const auto check = [](const Field& f, float reach) {
        const Bounds b = bounds(Extrude{.of = f, .height = 1});
        REQUIRE(b.finite());
        CHECK(b.high.x == doctest::Approx(reach).epsilon(1e-4));
        CHECK(b.high.z == doctest::Approx(0.5f).epsilon(1e-4));
    };
    check(square, 1);
    check(warped(Rotate{.angle = 45}, square), std::sqrt(2.f));
    check(warped(Mirror{.normal = {0, -1, 0}}, warped(Translate{{0.5f, 0.25f, 0}}, square)), 1.5f);
    FieldPolarArray array;
    array.of = square;
    array.count = 8;
    check(array, std::sqrt(2.f));
    CHECK(!bounds(warped(Rotate{.axis = {1, 0, 0}, .angle = 30}, square)).finite());
}

}  // namespace test_bounds
