// Polygons and Bézier shapes against brute force: angles under which their edges are seen, and searches along their
// curves. Refusals of what is no outline.
#include <doctest/doctest.h>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/profiles/bezier.hpp"
#include "phasetree/nodes/profiles/polygon.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra/outlines.hpp"

namespace test_outlines {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// On a raster of quarters as often as not: level edges, equal heights, repeated points.
glm::vec2 random_corner(Random& rng) {
    const glm::vec2 v(rng.uniform(-1, 1), rng.uniform(-1, 1));
    return rng.chance(0.4) ? glm::round(v * 4.f) / 4.f : v;
}

struct Comparison {
    int shapes = 0;
    std::size_t points = 0, inside = 0, outside_of_bounds = 0;
    double largest_error = 0;
};

template <class Node>
void compare(const Node& n, Random& rng, Comparison& c) {
    const std::span<const float> data = n.data();
    BoundsQuery query;
    const Bounds box = n.bounds(query, 0.1f);
    ++c.shapes;
    for (int i = 0; i < 100; ++i) {
        glm::vec3 p = rng.in(Bounds::centred(glm::vec3(1.5f)));
        if (i % 5 == 0) p = glm::round(p * 4.f) / 4.f;
        if (i % 7 == 0) p *= 3.f;
        const double expected = oracle::signed_value(n, glm::dvec3(p));
        const double error = std::abs(Node::distance(data.data(), Vec3<float>{p.x, p.y, p.z}) - expected);
        ++c.points;
        c.inside += expected < 0;
        c.outside_of_bounds += expected < 0.1 - 1e-5 && !box.contains(p);
        c.largest_error = std::max(c.largest_error, error / (1 + glm::length(p)));
        if (error > 1e-6 * (1 + glm::length(p))) {
            for (const glm::vec2& v : n.points) MESSAGE("(", v.x, ", ", v.y, ")");
            CAPTURE(p.x);
            CAPTURE(p.y);
            REQUIRE(error <= 1e-6 * (1 + glm::length(p)));
        }
    }
}

}  // namespace

TEST_CASE("a polygon's distance is that to its edges, negative where they are seen all around") {
    Random rng(191);
    Comparison c;
    while (c.shapes < 600) {
        Polygon n;
        for (int i = 3 + rng.below(5); i-- > 0;) n.points.push_back(random_corner(rng));
        try {
            n.prepare();
        } catch (const ModelError&) {
            continue;
        }
        compare(n, rng, c);
    }
    MESSAGE("largest error ", c.largest_error);
    CHECK(c.inside > c.points / 50);
    CHECK(c.outside_of_bounds == 0);
}

TEST_CASE("a Bezier shape's distance is that of a search along its curves") {
    Random rng(192);
    Comparison c;
    for (int shape = 0; shape < 300; ++shape) {
        Bezier n;
        const int count = 4 + rng.below(6);
        for (int i = 0; i < count; ++i) n.points.push_back(random_corner(rng));
        // A control point in line with its neighbours, perhaps beyond them; a corner that is its own control point.
        if (shape % 6 == 0) n.points[1] = glm::mix(n.points[0], n.points[2], rng.uniform(-1, 2));
        if (shape % 7 == 0) n.points[1] = n.points[0];
        // A hairpin.
        if (shape % 8 == 0) n.points[2] = n.points[0] + 0.001f * random_corner(rng);
        if (count % 2 != 0 || rng.chance(0.3)) n.thickness = rng.uniform(0.02f, 0.3f);
        n.prepare();
        compare(n, rng, c);
    }
    MESSAGE("largest error ", c.largest_error);
    CHECK(c.inside > c.points / 50);
    CHECK(c.outside_of_bounds == 0);
}

TEST_CASE("what is no outline is refused") {
    const auto refused = [](auto n, const char* why) { CHECK_THROWS_WITH_AS(n.prepare(), why, ModelError); };
    refused(Polygon{.points = {{0, 0}, {1, 1}, {1, 0}, {0, 1}}},
            "polygon: the edges from its points 1 and 3 cross or touch");
    refused(Polygon{.points = {{0, 0}, {2, 0}, {1, 0}, {1, 1}}},
            "polygon: the edges from its points 1 and 2 cross or touch");
    refused(Polygon{.points = {{0, 0}, {2, 0}, {2, 2}, {1, 0}}},
            "polygon: the edges from its points 1 and 3 cross or touch");
    refused(Polygon{.points = {{0, 0}, {1, 0}, {1, 0}, {0, 0}}}, "polygon: it needs three different points");
    refused(Polygon{.points = {{0, 0}, {1, 0}, {2e9f, 1}}}, "polygon: its points must be within 1e9 m of the origin");
    refused(Bezier{.points = {{0, 0}, {1, 0}, {1, 1}}},
            "bezier: an odd number of points is an open curve, which needs a thickness");
    refused(Bezier{.points = {{0, 0}, {1, 0}}}, "bezier: fewer than three points, or four for a closed curve");
    refused(Bezier{.points = {{1, 0}, {1, 0}, {1, 0}, {1, 0}}}, "bezier: all of its points are the same");
    CHECK_NOTHROW((Polygon{.points = {{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 0}}}.prepare()));
    CHECK_NOTHROW((Bezier{.points = {{0, 0}, {1, 0}, {1, 1}}, .thickness = 0.1f}.prepare()));
}

}  // namespace test_outlines
