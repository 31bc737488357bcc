// Objects under long chains of transforms: bounds and hits are those of the object placed directly.
#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/ellipsoid.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/link.hpp"
#include "phasetree/nodes/fields/octahedron.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/polyline.hpp"
#include "phasetree/nodes/fields/prism.hpp"
#include "phasetree/nodes/fields/pyramid.hpp"
#include "phasetree/nodes/fields/round_cone.hpp"
#include "phasetree/nodes/fields/rounded_box.hpp"
#include "phasetree/nodes/fields/rounded_cylinder.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/tetrahedron.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/tube.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/fields/wedge.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/profiles/circle.hpp"
#include "phasetree/nodes/profiles/extrude.hpp"
#include "phasetree/nodes/profiles/polygon.hpp"
#include "phasetree/nodes/profiles/rectangle.hpp"
#include "phasetree/nodes/profiles/revolve.hpp"
#include "phasetree/nodes/profiles/star.hpp"
#include "phasetree/nodes/warps/affine.hpp"
#include "phasetree/nodes/warps/mirror.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/stretch.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_transform_chains {

using namespace phasetree;
using namespace phasetree::tests;
using glm::dvec3;

namespace {

/// Points of an object that span most of it. Every box around the object must contain them.
struct Cloud {
    std::vector<dvec3> points;

    dvec3 extent() const {
        dvec3 low(1e30), high(-1e30);
        for (const dvec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
        return high - low;
    }
    dvec3 centre() const {
        dvec3 sum(0);
        for (const dvec3& p : points) sum += p;
        return sum / static_cast<double>(points.size());
    }
};

Cloud cloud_of(const Field& f, Random& rng, std::size_t count) {
    const Bounds b = bounds(f);
    Cloud cloud;
    while (cloud.points.size() < count)
        if (const dvec3 p(rng.in(b)); inside(f, p)) cloud.points.push_back(p);
    return cloud;
}

Field random_solid(Random& rng) {
    switch (rng.below(10)) {
        case 0:
            return Box{.size = {1, 0.6f, 0.3f}};
        case 1:
            return Cylinder{.radius = 0.3f, .height = 1};
        case 2:
            return Capsule{.from = {-0.5f, -0.4f, -0.3f}, .to = {0.5f, 0.4f, 0.3f}, .radius = 0.15f};
        case 3:
            return Torus{.major = 0.6f, .minor = 0.2f};
        case 4:
            return Tetrahedron{.radius = 0.8f};
        case 5:
            return Octahedron{.radius = 0.7f};
        case 6:
            return Wedge{.size = {1, 0.5f, 0.8f}};
        case 7:
            return Ellipsoid{.radii = {0.7f, 0.4f, 0.2f}};
        case 8:
            return Extrude{.of = Star{.points = 5, .radius = 0.7f, .inner_radius = 0.35f}, .height = 0.4f};
        default:
            return Revolve{.of = Rectangle{.width = 0.3f, .height = 0.7f}, .offset = 0.5f};
    }
}

/// Puts a random transform around a field, and moves its points. Sizes stay about one.
Field transformed(const Field& f, Cloud& cloud, Random& rng, bool with_mirrors) {
    const auto move = [&](auto&& map) {
        for (dvec3& p : cloud.points) p = map(p);
    };
    const auto factor = [&] {
        const double size = glm::length(cloud.extent());
        return rng.uniform(size > 1.5 ? 0.85f : 0.95f, size > 1.5 ? 1.05f : 1.15f);
    };
    switch (rng.below(with_mirrors ? 6 : 5)) {
        case 0: {
            const Rotate turn{.axis = rng.direction(), .angle = rng.uniform(-180, 180)};
            const dvec3 axis(turn.axis);
            const glm::dmat3 m(glm::rotate(glm::dmat4(1), glm::radians(static_cast<double>(turn.angle)), axis));
            move([&](const dvec3& p) { return m * p; });
            return warped(turn, f);
        }
        case 1: {
            // Back to the origin by half, and somewhere else.
            const glm::vec3 by = -0.5f * glm::vec3(cloud.centre()) + 0.3f * rng.direction();
            move([&](const dvec3& p) { return p + dvec3(by); });
            return warped(Translate{by}, f);
        }
        case 2: {
            const float s = factor();
            move([&](const dvec3& p) { return static_cast<double>(s) * p; });
            return warped(Scale{s}, f);
        }
        case 3: {
            const glm::vec3 s(factor(), factor(), factor());
            move([&](const dvec3& p) { return dvec3(s) * p; });
            return warped(Stretch{s}, f);
        }
        case 4: {
            Affine a;
            for (glm::vec3* column : {&a.x, &a.y, &a.z}) *column = *column * factor() + 0.05f * rng.direction();
            a.by = 0.2f * rng.direction();
            move([&](const dvec3& p) { return p.x * dvec3(a.x) + p.y * dvec3(a.y) + p.z * dvec3(a.z) + dvec3(a.by); });
            return warped(a, f);
        }
        default: {
            glm::vec3 normal = rng.direction();
            if (glm::dot(dvec3(normal), cloud.centre()) < 0) normal = -normal;
            const dvec3 n = glm::normalize(dvec3(normal));
            std::vector<dvec3> both;
            for (const dvec3& p : cloud.points) {
                if (glm::dot(p, n) < 0) continue;
                both.push_back(p);
                both.push_back(p - 2 * glm::dot(p, n) * n);
            }
            while (both.size() > 8000) {
                std::swap(both[static_cast<std::size_t>(rng.below(static_cast<int>(both.size())))], both.back());
                both.pop_back();
            }
            cloud.points = std::move(both);
            return warped(Mirror{normal}, f);
        }
    }
}

void check_bounds(const Field& f, const Cloud& cloud) {
    const Bounds b = bounds(f);
    CAPTURE(b.low.x);
    CAPTURE(b.high.x);
    CAPTURE(cloud.extent().x);
    REQUIRE(b.finite());
    const Bounds wide = b.inflated(1e-5f * b.diagonal());
    for (const dvec3& p : cloud.points) REQUIRE(wide.contains(glm::vec3(p)));
    const dvec3 extent = cloud.extent();
    for (int i = 0; i < 3; ++i) CHECK(static_cast<double>(b.extent()[i]) <= 2 * extent[i]);
}

/// Rays to points of the object hit it where doubles place its surface. Tests the whole object and, on request, its
/// cells, because those of a long chain take seconds to build.
void check_hits(const Field& f, const Cloud& cloud, Random& rng, bool with_cells) {
    const Phased object = Set{.phase = Phase{1}, .of = f};
    const InterfaceTracer tracer(object);
    std::optional<InterfaceCells> cells;
    if (with_cells) cells.emplace(object);
    Evaluator::Workspace w;
    const double resolution = static_cast<double>(tracer.resolution());
    CHECK(resolution <= 2 * 2e-6 * glm::length(cloud.extent()));
    int off = 0;
    for (int n = 0; n < 20; ++n) {
        const auto which = static_cast<std::size_t>(rng.below(static_cast<int>(cloud.points.size())));
        const glm::vec3 d = rng.direction(), o = glm::vec3(cloud.points[which]) - 2 * tracer.bounds().diagonal() * d;
        const float length = 4 * tracer.bounds().diagonal();
        // In doubles, from a place in vacuum to one inside of it.
        const auto is_inside = [&](double t) { return inside(f, dvec3(o) + t * dvec3(d)); };
        double low = 0, high = 0;
        constexpr int steps = 1000;
        for (int i = 1; i <= steps && high == 0; ++i) {
            const double t = static_cast<double>(length) * i / steps;
            (is_inside(t) ? high : low) = t;
        }
        if (high == 0) continue;  // the point is near the surface, and the ray is in it for less than a step
        while (high - low > 0.1 * resolution) (is_inside(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
        // Coordinates are rounded at each of the maps, and at a grazing angle, this moves the hit farther along the
        // ray.
        const double tolerance = 40 * resolution;
        // The first step may have passed something thin: an earlier hit must be where doubles have a surface.
        const auto is_surface = [&](double t) {
            int inner = 0;
            for (int i = -20; i <= 20; ++i) inner += is_inside(t + tolerance * i / 20);
            return inner > 0 && inner < 41;
        };
        const auto is_off = [&](double t) { return !(t < low + tolerance) || !is_surface(t); };
        const auto hit = tracer.first_crossing(o, d, 0, length, vacuum, w);
        REQUIRE(hit.has_value());
        off += is_off(static_cast<double>(hit->t_from));
        if (!cells) continue;
        std::optional<float> first;
        for (std::size_t i = 0; i < cells->size(); ++i) {
            TraceCounters counters;
            if (const auto c = cells->first_crossing(i, o, d, 0, first.value_or(length), vacuum, w, counters))
                first = c->t_from;
        }
        REQUIRE(first.has_value());
        off += is_off(static_cast<double>(*first));
    }
    CHECK(off == 0);
}

}  // namespace

TEST_CASE("turns that undo each other leave the bounds and the hits") {
    Random rng(801);
    const Field box = Box{.size = {1, 1, 1}};
    const Cloud cloud = cloud_of(box, rng, 1000);
    for (const int n : {2, 10, 60, 200, 390}) {
        CAPTURE(n);
        Field f = box;
        for (int i = 0; i < n; ++i) f = warped(Rotate{.angle = i % 2 == 0 ? 45.f : -45.f}, f);
        const Bounds b = bounds(f);
        for (int i = 0; i < 3; ++i) {
            CHECK(b.low[i] <= -0.5f);
            CHECK(b.high[i] >= 0.5f);
            CHECK(b.extent()[i] < 1.001f);
        }
        check_hits(f, cloud, rng, n <= 10);
    }
}

TEST_CASE("two hundred random transforms: the bounds are at most twice the object's, and rays hit it where it is") {
    Random rng(802);
    const int chains = long_tests() ? 1000 : 30;
    for (int chain = 0; chain < chains; ++chain) {
        CAPTURE(chain);
        Field f = random_solid(rng);
        Cloud cloud = cloud_of(f, rng, 8000);
        const bool with_mirrors = chain % 2 == 1;
        for (int i = 0; i < 200; ++i) f = transformed(f, cloud, rng, with_mirrors);
        check_bounds(f, cloud);
        check_hits(f, cloud, rng, false);
    }
}

TEST_CASE("chains of links: a polygon of joints and an arm") {
    Random rng(803);
    for (const int links : {3, 7, 24, 60}) {
        for (const bool is_closed : {true, false}) {
            CAPTURE(links);
            CAPTURE(is_closed);
            // From the last link to the first; where the joints come to lie, from the first.
            std::vector<Rotate> joints;
            for (int i = 0; i < links; ++i)
                joints.push_back(is_closed ? Rotate{.axis = {1, 0, 0}, .angle = 360.f / static_cast<float>(links)}
                                           : Rotate{.axis = rng.direction(), .angle = rng.uniform(-40, 40)});
            const Field link = Capsule{.from = {0, 0, 0}, .to = {0, 0, 1}, .radius = 0.2f};
            Field chain = link;
            for (std::size_t i = joints.size() - 1; i-- > 0;)
                chain = Union{.of = {link, warped(Translate{{0, 0, 1}}, warped(joints[i], chain))}};
            glm::dmat4 frame(1);
            std::vector<glm::vec3> places;
            std::vector<Field> direct;
            for (int i = 0; i < links; ++i) {
                const auto at = [&](double z) { return glm::vec3(frame * glm::dvec4(0, 0, z, 1)); };
                direct.push_back(Capsule{.from = at(0), .to = at(1), .radius = 0.2f});
                places.push_back(at(0));
                places.push_back(at(1));
                frame = glm::translate(frame, dvec3(0, 0, 1));
                frame = glm::rotate(frame, glm::radians(static_cast<double>(joints[static_cast<std::size_t>(i)].angle)),
                                    dvec3(joints[static_cast<std::size_t>(i)].axis));
            }
            const Field placed = Union{.of = direct};
            const Bounds b = bounds(chain), expected = bounds(placed);
            for (int i = 0; i < 3; ++i) {
                CHECK(b.low[i] <= expected.low[i] + 1e-5f * expected.diagonal());
                CHECK(b.high[i] >= expected.high[i] - 1e-5f * expected.diagonal());
                CHECK(b.extent()[i] <= 1.01f * expected.extent()[i]);
            }
            const InterfaceTracer jointed(Phased(Set{.phase = Phase{1}, .of = chain})),
                one(Phased(Set{.phase = Phase{1}, .of = placed}));
            CHECK(jointed.resolution() < 1.01f * one.resolution());
            Evaluator::Workspace w;
            int off = 0;
            for (int n = 0; n < 300; ++n) {
                const glm::vec3 d = rng.direction();
                const glm::vec3 to = places[static_cast<std::size_t>(rng.below(static_cast<int>(places.size())))] +
                                     0.15f * rng.direction();
                const glm::vec3 o = to - 2 * b.diagonal() * d;
                const auto a = jointed.first_crossing(o, d, 0, 1e9f, vacuum, w);
                const auto c = one.first_crossing(o, d, 0, 1e9f, vacuum, w);
                REQUIRE(c.has_value());
                REQUIRE(a.has_value());
                const float cosine = std::abs(glm::dot(one.normal(*c, d), d));
                off += !(std::abs(a->t_from - c->t_from) * cosine < 4 * one.resolution());
            }
            CHECK(off == 0);
        }
    }
}

TEST_CASE("a primitive that is turned has bounds that touch it") {
    Random rng(804);
    const std::vector<Field> solids{
        Sphere{},
        Box{.size = {1, 2, 3}},
        RoundedBox{.size = {1, 2, 3}, .radius = 0.4f},
        Cylinder{.radius = 0.5f, .height = 2},
        RoundedCylinder{.radius = 0.5f, .height = 2, .edge = 0.2f},
        CappedCone{.radius_bottom = 1, .radius_top = 0.25f, .height = 2},
        Capsule{.from = {1, 0, 0}, .to = {0, 2, 1}, .radius = 0.5f},
        RoundCone{.from = {1, 0, 0}, .radius_from = 0.5f, .to = {0, 2, 1}, .radius_to = 0.25f},
        Torus{.major = 1, .minor = 0.4f},
        Link{.length = 1, .major = 0.5f, .minor = 0.3f},
        Tube{.radius = 1, .inner_radius = 0.5f, .height = 2},
        Ellipsoid{.radii = {1, 0.6f, 0.3f}},
        Prism{.sides = 3, .radius = 1, .height = 1},
        Prism{.sides = 5, .radius = 1, .height = 1},
        Wedge{.size = {1, 1, 1}},
        Pyramid{.base = 1, .height = 1},
        Octahedron{},
        Tetrahedron{},
        Polyline{.points = {{0, 0, 0}, {1, 1, 1}, {1, 2, 1}}, .radius = 0.3f},
        Extrude{.of = Circle{.radius = 1}, .height = 1},
        Extrude{.of = Polygon{.points = {{0, 0}, {2, 0}, {0, 1}}}, .height = 1},
        Extrude{.of = Star{.points = 3, .radius = 1, .inner_radius = 0.6f}, .height = 1},
        Revolve{.of = Circle{.radius = 0.4f}, .offset = 1},
    };
    for (std::size_t index = 0; index < solids.size(); ++index) {
        CAPTURE(index);
        const Field& solid = solids[index];
        for (int k = 0; k < 4; ++k) {
            const Rotate turn{.axis = rng.direction(), .angle = rng.uniform(20, 70)};
            Cloud cloud = cloud_of(solid, rng, 20000);
            const glm::dmat3 m(
                glm::rotate(glm::dmat4(1), glm::radians(static_cast<double>(turn.angle)), dvec3(turn.axis)));
            for (dvec3& p : cloud.points) p = m * p;
            const Bounds b = bounds(warped(turn, solid));
            for (const dvec3& p : cloud.points) REQUIRE(b.inflated(1e-5f).contains(glm::vec3(p)));
            // Random points miss a corner's tip.
            for (int i = 0; i < 3; ++i) CHECK(static_cast<double>(b.extent()[i]) < 1.25 * cloud.extent()[i]);
        }
    }
}

TEST_CASE("a cut along a node's own axes bounds what is turned") {
    // Each half-space alone is unbounded along any direction but its own.
    const auto half_space = [](const glm::vec3& n) { return Field(Plane{.normal = n, .offset = 0.5f}); };
    const Field cube = Intersection{.of = {half_space({1, 0, 0}), half_space({-1, 0, 0}), half_space({0, 1, 0}),
                                           half_space({0, -1, 0}), half_space({0, 0, 1}), half_space({0, 0, -1})}};
    Field f = cube;
    for (int i = 0; i < 20; ++i) f = warped(Rotate{.axis = {1, 1, 0}, .angle = i % 2 == 0 ? 33.f : -33.f}, f);
    CHECK(bounds(f).finite());
    CHECK(bounds(f).extent().x < 1.001f);
    CHECK(bounds(f).extent().z >= 1);
    // A mirror's other half is not there.
    const Field gone = warped(Mirror{.normal = {1, 0, 0}}, warped(Translate{{-3, 0, 0}}, Field(Sphere{})));
    CHECK(bounds(warped(Rotate{.angle = 30}, gone)).empty());
}

TEST_CASE("shapes of turned shapes are bounded in no time, if not tightly") {
    // 2⁴⁰ copies, each along directions of its own.
    Field f = Box{};
    for (int i = 0; i < 40; ++i)
        f = Union{.of = {warped(Rotate{.axis = {1, 0, static_cast<float>(i)}, .angle = 10}, f), f}};
    const Bounds b = bounds(f);
    CHECK(b.finite());
    CHECK(b.contains({0.5f, 0.5f, 0.5f}));
}

}  // namespace test_transform_chains
