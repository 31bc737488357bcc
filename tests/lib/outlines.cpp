// Polygons and Bézier shapes against brute force: angles under which their edges are seen, and searches along their
// curves. Refusals of what is no outline.
#include <doctest/doctest.h>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/profiles/bezier.hpp"
#include "phasetree/nodes/profiles/polygon.hpp"
#include "phasetree/nodes/profiles/text.hpp"
#include "support/random_text.hpp"
#include "support/set_algebra/outlines.hpp"

namespace test_outlines {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Half of the points are on a grid of quarters: level edges, equal heights, repeated points. Some coordinates are as
/// small as what r cos(π/2) gives instead of zero.
glm::vec2 random_corner(Random& rng) {
    glm::vec2 v(rng.uniform(-1, 1), rng.uniform(-1, 1));
    if (rng.chance(0.4)) v = glm::round(v * 4.f) / 4.f;
    for (int i = 0; i < 2; ++i)
        if (rng.chance(0.1)) v[i] = std::pow(10.f, rng.uniform(-21, -8)) * (rng.chance(0.5) ? 1.f : -1.f);
    return v;
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

struct BoxComparison {
    std::size_t boxes = 0, pieces = 0, heights = 0, points = 0, inside = 0, different = 0;
};

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
        // Hardly bent.
        if (shape % 3 == 0)
            n.points[1] = 0.5f * (n.points[0] + n.points[2]) + std::pow(10.f, rng.uniform(-6, -2)) * random_corner(rng);
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

TEST_CASE("a text's distance is that to its strokes, each without its holes") {
    Random rng(193);
    double largest_error = 0;
    std::size_t points = 0, inside = 0, outside_of_bounds = 0;
    for (int shape = 0; shape < 300; ++shape) {
        Text n{.size = rng.uniform(0.3f, 2),
               .align = rng.chance(0.5) ? 0.5f : rng.uniform(0, 1),
               .spacing = rng.chance(0.5) ? 0.f : rng.uniform(-0.2f, 1),
               .line_height = rng.uniform(0.5f, 2)};
        n.file.content = std::make_shared<const TextOutlines>(random_text(rng));
        n.prepare();
        const Field field = n;
        BoundsQuery query;
        const Bounds box = n.bounds(query, 0.1f);
        for (int i = 0; i < 100; ++i) {
            const glm::vec3 p = rng.in(Bounds{n.box.low - 0.3f, n.box.high + 0.3f});
            const double expected = oracle::signed_value(n, glm::dvec3(p));
            const double error = std::abs(distance(field, p) - expected);
            ++points;
            inside += expected < 0;
            outside_of_bounds += expected < 0.1 - 1e-5 && !box.contains(p);
            largest_error = std::max(largest_error, error / (1 + glm::length(p)));
        }
    }
    MESSAGE("largest error ", largest_error);
    CHECK(largest_error < 1e-6);
    CHECK(inside > points / 20);
    CHECK(outside_of_bounds == 0);
}

// Halves and thirds of boxes: the pieces in a box are searched for among those of the surrounding box.
template <class Primitive>
void compare_in_boxes(const Primitive& primitive, const Bounds& whole, Random& rng, BoxComparison& c) {
    const float* const data = primitive.data().data();
    std::vector<float> around;
    for (Bounds box = whole; box.diagonal() > 0.01f * whole.diagonal();) {
        PointRange range;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            range.centre[k] = 0.5 * (static_cast<double>(box.low[i]) + static_cast<double>(box.high[i]));
            range.half_extents[k] = 0.5 * (static_cast<double>(box.high[i]) - static_cast<double>(box.low[i]));
        }
        std::vector<float> few;
        if (Primitive::specialise(data, range, around, few)) {
            ++c.boxes;
            REQUIRE(OutlineInBox::Specialised::is_sound(few));
            REQUIRE(OutlineInBox::Specialised::floats(few.data()) == few.size());
            c.pieces += static_cast<std::size_t>(few[0]);
            c.heights += few[3] > 0;
            for (int i = 0; i < 30; ++i) {
                glm::vec3 p = rng.in(box);
                // The box's sides, and heights at which pieces end.
                if (i % 3 == 0) p.x = rng.chance(0.5) ? box.low.x : box.high.x;
                if (i % 4 == 0) p.y = rng.chance(0.5) ? box.low.y : box.high.y;
                if (i % 5 == 0) {
                    const auto piece = static_cast<std::size_t>(rng.below(static_cast<int>(data[0])));
                    const float y = data[OutlineInBox::head + OutlinePieces::floats * piece + 1];
                    if (y >= box.low.y && y <= box.high.y) p.y = y;
                }
                const Vec3<float> q{p.x, p.y, p.z};
                const float of_all = Primitive::distance(data, q);
                ++c.points;
                c.different += !(OutlineInBox::Specialised::distance(few.data(), q) == of_all);
                c.inside += of_all < 0;
            }
            around = few;
        }
        const float share = rng.chance(0.5) ? 0.5f : 0.33f;
        const glm::vec3 extent = share * box.extent();
        box.low += (box.extent() - extent) * glm::vec3(rng.uniform(0, 1), rng.uniform(0, 1), 0.5f);
        box.high = box.low + extent;
    }
}

TEST_CASE("in a box the few pieces that matter there give the same distances to the last bit") {
    Random rng(194);
    BoxComparison c;
    for (int shape = 0; shape < (long_tests() ? 20'000 : 400); ++shape) {
        Bezier curve;
        for (int i = 8 + 2 * rng.below(12); i-- > 0;) curve.points.push_back(random_corner(rng));
        if (rng.chance(0.2)) curve.thickness = 0.05f;
        curve.prepare();
        compare_in_boxes(curve, Bounds::centred(glm::vec3(1.5f)), rng, c);
        Polygon star;
        const int corners = 5 + rng.below(20);
        for (int i = 0; i < corners; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(corners);
            star.points.push_back(rng.uniform(0.3f, 1.2f) * glm::vec2(std::cos(angle), std::sin(angle)));
        }
        star.prepare();
        compare_in_boxes(star, Bounds::centred(glm::vec3(1.5f)), rng, c);
        Text text{.size = rng.uniform(0.3f, 2)};
        text.file.content = std::make_shared<const TextOutlines>(random_text(rng));
        text.prepare();
        for (const Text::Stroke& stroke : text.strokes)
            compare_in_boxes(stroke, Bounds{text.box.low - 0.1f, text.box.high + 0.1f}, rng, c);
    }
    MESSAGE(c.points, " points in ", c.boxes, " boxes of ",
            static_cast<double>(c.pieces) / static_cast<double>(c.boxes), " pieces; ", c.heights,
            " of them with heights");
    CHECK(c.different == 0);
    CHECK(c.inside > c.points / 20);
    CHECK(c.heights > c.boxes / 100);
}

TEST_CASE("what is no outline is rejected") {
    const auto refused = [](auto n, const char* why) { CHECK_THROWS_WITH_AS(n.prepare(), why, ModelError); };
    refused(Polygon{.points = {{0, 0}, {1, 1}, {1, 0}, {0, 1}}},
            "polygon: the edges from its points 1 and 3 (not counting repeated points) cross or touch");
    refused(Polygon{.points = {{0, 0}, {2, 0}, {1, 0}, {1, 1}}},
            "polygon: the edges from its points 1 and 2 (not counting repeated points) cross or touch");
    refused(Polygon{.points = {{0, 0}, {2, 0}, {2, 2}, {1, 0}}},
            "polygon: the edges from its points 1 and 3 (not counting repeated points) cross or touch");
    refused(Polygon{.points = {{0, 0}, {1, 0}, {1, 0}, {0, 0}}},
            "polygon: at least three different points are required");
    refused(Polygon{.points = {{0, 0}, {1, 0}, {2e9f, 1}}}, "polygon: its points must be within 1e9 m of the origin");
    refused(Bezier{.points = {{0, 0}, {1, 0}, {1, 1}}},
            "bezier: an odd number of points is an open curve, which needs a thickness");
    refused(Bezier{.points = {{0, 0}, {1, 0}}},
            "bezier: an open curve needs at least three points, a closed one at least four");
    refused(Bezier{.points = {{1, 0}, {1, 0}, {1, 0}, {1, 0}}}, "bezier: all of its points are the same");
    CHECK_NOTHROW((Polygon{.points = {{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 0}}}.prepare()));
    CHECK_NOTHROW((Bezier{.points = {{0, 0}, {1, 0}, {1, 1}}, .thickness = 0.1f}.prepare()));
}

}  // namespace test_outlines
