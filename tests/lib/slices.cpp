// Slices: outlines of random objects agree with labels, without gaps or overlaps, for any axis, number of phases and
// number of threads. Bad input is rejected with a message.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/measuring/slice.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/uniform.hpp"

namespace test_slices {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr Phase first{1}, second{2};

float between(Uniform& rng, float low, float high) {
    return low + (high - low) * rng();
}

// Balls and boxes of five phases that overlap.
Phased random_object(Uniform& rng, int parts) {
    Over all;
    for (int i = 0; i < parts; ++i) {
        const Field ball = Sphere{.radius = between(rng, 0.15f, 0.45f)};
        const Field box = Box{.size = {between(rng, 0.2f, 1.2f), between(rng, 0.2f, 1.2f), between(rng, 0.2f, 1.2f)}};
        const glm::vec3 by(between(rng, -1, 1), between(rng, -1, 1), between(rng, -0.3f, 0.3f));
        all.of.push_back(Set{.phase = Phase{static_cast<std::uint8_t>(1 + i % 5)},
                             .of = warped(Translate{.by = by}, i % 2 == 0 ? ball : box)});
    }
    return all;
}

// What the outlines say about a point.
struct Drawn {
    Phase phase = vacuum;
    double distance = 1e30;  // to the closest outline
};

Drawn drawn_at(const Slice& slice, const glm::dvec2& p) {
    Drawn result;
    std::map<Phase, int> winding;
    for (const Slice::Loop& loop : slice.loops)
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
            const glm::dvec2 a = slice.vertices[loop.vertices[i]];
            const glm::dvec2 b = slice.vertices[loop.vertices[(i + 1) % loop.vertices.size()]];
            const glm::dvec2 d = b - a;
            const double square = glm::dot(d, d),
                         t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0;
            result.distance = std::min(result.distance, glm::length(p - a - t * d));
            const bool crosses = (a.y <= p.y) != (b.y <= p.y);
            if (crosses && a.x + (p.y - a.y) / d.y * d.x > p.x) winding[loop.phase] += d.y > 0 ? 1 : -1;
        }
    for (const auto& [phase, turns] : winding) {
        CHECK((result.distance < 1e-6 || turns == 0 || turns == 1 || (phase == vacuum && turns == -1)));
        if (turns > 0) result.phase = phase;
    }
    return result;
}

// Each side of an outline must occur in the other direction in the outline of the phase beside it.
void check_sides(const Slice& slice) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const Slice::Loop& loop : slice.loops)
        for (std::size_t i = 0; i < loop.vertices.size(); ++i)
            ++sides[{loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]}];
    for (const auto& [side, count] : sides) {
        const auto other = sides.find({side.second, side.first});
        REQUIRE(other != sides.end());
        CHECK(other->second == count);
    }
}

// Whether phases change within a distance of a point.
bool is_near_change(const Evaluator& evaluator, const SlicePlane& plane, const glm::dvec2& p, double distance) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    const auto label = [&](double u, double v) {
        return evaluator.label(plane.point(static_cast<float>(u), static_cast<float>(v)), workspace);
    };
    const Phase here = label(p.x, p.y);
    for (int i = 0; i < 48; ++i) {
        const double angle = 2 * std::numbers::pi * i / 24, r = i < 24 ? distance : 0.5 * distance;
        if (label(p.x + r * std::cos(angle), p.y + r * std::sin(angle)) != here) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("outlines are where phases change, far from them the drawn phase is the label, and neighbours share sides") {
    Uniform rng(1);
    std::size_t far = 0;
    for (int round = 0; round < 12; ++round) {
        const Phased object = random_object(rng, 3 + 3 * round);
        const SlicePlane plane{round % 3, between(rng, -0.1f, 0.1f)};
        SliceOptions options;
        options.tolerance = round % 2 == 0 ? 0.05 : 0.005;
        const Slice found = slice(object, plane, options);
        check_sides(found);
        double sum = 0;
        for (int i = 0; i < Phase::capacity; ++i) sum += found.area(Phase{static_cast<std::uint8_t>(i)});
        CHECK(std::abs(sum) < 1e-12);
        const Evaluator evaluator(record(object));
        for (const Slice::Loop& loop : found.loops)
            for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
                const glm::dvec2 a = found.vertices[loop.vertices[i]];
                const glm::dvec2 b = found.vertices[loop.vertices[(i + 1) % loop.vertices.size()]];
                for (const glm::dvec2& p : {a, 0.5 * (a + b)})
                    CHECK(is_near_change(evaluator, plane, p, options.tolerance));
            }
        for (int i = 0; i < 200; ++i) {
            const float u = between(rng, -1.5f, 1.5f), v = between(rng, -1.5f, 1.5f);
            const Drawn drawn = drawn_at(found, {u, v});
            if (drawn.distance <= options.tolerance) continue;
            ++far;
            CHECK(drawn.phase == evaluator.label(plane.point(u, v), Evaluator::thread_workspace()));
        }
    }
    CHECK(far > 1500);
}

TEST_CASE("a detail that falls between the corners of squares is counted, with its place") {
    const Field speck = warped(Translate{.by = {0.613f, -0.271f, 0}}, Sphere{.radius = 0.002f});
    const Phased object =
        Over{.of = {Set{.phase = second, .of = speck}, Set{.phase = first, .of = Box{.size = {3, 3, 3}}}}};
    SliceOptions options;
    options.tolerance = 0.2;
    const Slice coarse = slice(object, {2, 0}, options);
    CHECK(coarse.area(second) == 0);
    REQUIRE(coarse.unexplained > 0);
    REQUIRE(coarse.first_unexplained);
    CHECK(glm::length(glm::dvec2(*coarse.first_unexplained) - glm::dvec2(0.613, -0.271)) < options.tolerance);
    options.tolerance = 0.002;
    const Slice fine = slice(object, {2, 0}, options);
    CHECK(fine.area(second) > 0);
    CHECK(fine.unexplained == 0);
}

TEST_CASE("areas are those of closed forms") {
    constexpr double pi = std::numbers::pi;
    SliceOptions options;
    options.tolerance = 0.002;
    for (int axis = 0; axis < 3; ++axis) {
        const Phased ball = Set{.phase = first, .of = warped(Translate{.by = {5, 6, 7}}, Sphere{.radius = 1})};
        const double r2 = 1 - 0.36;
        CHECK(slice(ball, {axis, 5.6f + static_cast<float>(axis)}, options).area(first) ==
              doctest::Approx(pi * r2).epsilon(1e-3));
    }
    const Phased box = Over{
        .of = {Set{.phase = first, .of = Sphere{.radius = 0.4f}}, Set{.phase = second, .of = Box{.size = {1, 2, 3}}}}};
    const Slice cut = slice(box, {2, 0}, options);
    CHECK(cut.area(first) == doctest::Approx(pi * 0.16).epsilon(1e-3));
    CHECK(std::abs(cut.area(first) + cut.area(second) - 2) < 1e-5);
    CHECK(cut.area(vacuum) == doctest::Approx(-2).epsilon(1e-5));
    CHECK(cut.unexplained == 0);
    // Outside of the object there is nothing.
    CHECK(slice(box, {2, 9}, options).loops.empty());
}

TEST_CASE("phases that touch in a point or along a line are closed polygons") {
    const auto cube = [](Phase phase, const glm::vec3& by) {
        return Phased(Set{.phase = phase, .of = warped(Translate{.by = by}, Box{.size = glm::vec3(1)})});
    };
    for (const Phase other : {first, second}) {
        const Slice found =
            slice(Over{.of = {cube(first, {-0.5f, -0.5f, 0}), cube(other, {0.5f, 0.5f, 0})}}, {2, 0.2f});
        check_sides(found);
        CHECK(found.area(first) + (other == first ? 0 : found.area(other)) == doctest::Approx(2).epsilon(1e-5));
    }
}

TEST_CASE("a slice does not depend on threads") {
    Uniform rng(2);
    const Phased object = random_object(rng, 9);
    const Slice several = slice(object, {2, 0.05f});
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Slice alone = slice(object, {2, 0.05f});
    CHECK(several.vertices == alone.vertices);
    REQUIRE(several.loops.size() == alone.loops.size());
    for (std::size_t i = 0; i < alone.loops.size(); ++i) {
        CHECK(several.loops[i].phase == alone.loops[i].phase);
        CHECK(several.loops[i].vertices == alone.loops[i].vertices);
    }
}

TEST_CASE("slicing can be cancelled, and bad input is rejected") {
    const Phased ball = Set{.phase = first, .of = Sphere{.radius = 1}};
    SliceOptions cancelled;
    cancelled.cancelled = [] { return true; };
    CHECK_THROWS_AS(slice(ball, {2, 0}, cancelled), SlicingCancelled);
    const auto rejects = [&](const Phased& object, const SlicePlane& plane, double tolerance, const char* words) {
        SliceOptions options;
        options.tolerance = tolerance;
        CHECK_THROWS_WITH_AS(slice(object, plane, options), doctest::Contains(words), ModelError);
    };
    rejects(ball, {3, 0}, 0, "no axis 3");
    rejects(ball, {2, std::nanf("")}, 0, "finite number");
    rejects(ball, {2, 0}, -1, "the tolerance must be a positive length, or 0");
    rejects(ball, {2, 0}, INFINITY, "the tolerance must be a positive length, or 0");
    rejects(ball, {2, 0}, 1e-5, "too fine for a slice that is 2");
    rejects(Set{.phase = first, .of = Plane{}}, {2, 0}, 0, "unbounded");
    const Phased far = Set{.phase = first, .of = warped(Translate{.by = {10000, 0, 0}}, Sphere{.radius = 1})};
    rejects(far, {2, 0}, 0.05, "finer than 32-bit coordinates allow");
    // All of a face is in doubt.
    SliceOptions few;
    few.max_squares = 100'000;
    CHECK_THROWS_WITH_AS(slice(Set{.phase = first, .of = Box{.size = {1, 1, 1}}}, {2, 0.5f}, few),
                         doctest::Contains("move the plane if it lies in a face"), ModelError);
}

}  // namespace test_slices
