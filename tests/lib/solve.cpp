// Solving: brackets contain the solutions of closed forms, and their ends are certainly on different sides of the
// target; results do not depend on threads; bad input is rejected in words.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "phasetree/measuring/solve.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace test_solve {

using namespace phasetree;

namespace {

constexpr double pi = std::numbers::pi;
constexpr Phase first{1}, second{2};

Phased ball(double radius) {
    return Set{.phase = first, .of = Sphere{.radius = static_cast<float>(radius)}};
}

// A box of 1 × 1 × 2 around the origin, filled up to a level, and a ball of another phase beside it.
Phased filled(double level) {
    const Phased box = Set{.phase = second, .of = Box{.size = {1, 1, 2}}};
    return Over{.of = {warped(Translate{.by = {3, 0, 0}}, ball(0.7)),
                       Phased(IntersectShape{.of = box, .shape = Plane{.offset = static_cast<float>(level)}})}};
}

// Checks what is certain about a bracket.
void check_bracket(const SolveResult& r, double solution, double target, double width) {
    REQUIRE(r.has_bracket());
    REQUIRE(r.best);
    CHECK(r.end == SolveEnd::width);
    CHECK(r.high->at - r.low->at <= width);
    CHECK(r.low->at <= solution + 1e-6);
    CHECK(r.high->at >= solution - 1e-6);
    CHECK(r.low->at <= r.best->at);
    CHECK(r.best->at <= r.high->at);
    const bool rises = r.low->measure.high < target;
    CHECK((rises ? r.high->measure.low > target : r.low->measure.low > target && r.high->measure.high < target));
    CHECK(r.best->measure.low <= r.best->measure.estimate);
}

SolveOptions to(double width) {
    SolveOptions options;
    options.width = width;
    return options;
}

}  // namespace

TEST_CASE("a bracket contains the solution of a closed form") {
    for (const double radius : {0.6, 1.7}) {
        const double volume = 4 * pi / 3 * radius * radius * radius;
        check_bracket(solve(ball, {{{first, 1}}, volume}, 0.5, 1.9, to(0.005)), radius, volume, 0.005);
        check_bracket(solve(ball, {{{first, 2.5}}, 2.5 * volume}, 0.5, 1.9, to(0.01)), radius, 2.5 * volume, 0.01);
    }
    check_bracket(solve(filled, {{{second, 1}}, 1.3}, -0.9, 0.9), 0.3, 1.3, 1.8e-3);
    const double whole = 4 * pi / 3 * 0.343 + 1.3;
    check_bracket(solve(filled, {{{first, 1}, {second, 1}}, whole}, -0.9, 0.9, to(0.01)), 0.3, whole, 0.01);
}

TEST_CASE("a solution in the middle of the bracket, where no interval decides, is found nevertheless") {
    check_bracket(solve(filled, {{{second, 1}}, 1}, -0.5, 0.5), 0, 1, 1e-3);
}

TEST_CASE("the measure may fall") {
    const auto falling = [](double x) { return ball(2 - x); };
    check_bracket(solve(falling, {{{first, 1}}, 4 * pi / 3}, 0.5, 1.4, to(0.005)), 1, 4 * pi / 3, 0.005);
}

TEST_CASE("a jump across the target is bracketed") {
    const auto jump = [](double x) { return x < 0.7 ? ball(1) : ball(1.2); };
    const SolveResult r = solve(jump, {{{first, 1}}, 5}, 0, 1);
    check_bracket(r, 0.7, 5, 1e-3);
}

TEST_CASE("an empty object has no volume") {
    // The plane is below the box.
    const auto box = [](double x) {
        return Phased(IntersectShape{.of = Set{.phase = first, .of = Box{.size = {1, 1, 1}}},
                                     .shape = Plane{.offset = static_cast<float>(x)}});
    };
    check_bracket(solve(box, {{{first, 1}}, 0.5}, -2, 0.45), 0, 0.5, 2.45e-3);
}

TEST_CASE("without a bracket, both ends are reported") {
    const SolveResult below = solve(ball, {{{first, 1}}, 100}, 0.5, 1);
    CHECK(below.end == SolveEnd::same_side);
    CHECK(!below.has_bracket());
    REQUIRE(below.low);
    REQUIRE(below.high);
    CHECK(below.high->measure.high < 100);
    CHECK(solve(ball, {{{first, 1}}, 0.01}, 0.5, 1).end == SolveEnd::same_side);
}

TEST_CASE("where precision ends, the number that is undecided is reported") {
    SolveOptions options = to(1e-9);
    options.max_boxes = 2000;
    const SolveResult r = solve(ball, {{{first, 1}}, 4 * pi / 3}, 0.5, 1.7, options);
    CHECK(r.end == SolveEnd::undecided);
    CHECK(r.has_bracket());
    CHECK(r.high->at - r.low->at < 0.2);
    REQUIRE(r.undecided);
    CHECK(r.undecided->measure.contains(4 * pi / 3));
    // An end may be undecided, too.
    const SolveResult at_end = solve(ball, {{{first, 1}}, 4 * pi / 3}, 1, 1.7, options);
    CHECK(at_end.end == SolveEnd::undecided);
    CHECK(!at_end.best);
    REQUIRE(at_end.undecided);
    CHECK(at_end.undecided->at == 1);
}

TEST_CASE("a solution does not depend on threads") {
    const SolveResult several = solve(filled, {{{second, 1}}, 1.3}, -0.9, 0.9, to(0.01));
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const SolveResult alone = solve(filled, {{{second, 1}}, 1.3}, -0.9, 0.9, to(0.01));
    CHECK(several.measurements == alone.measurements);
    CHECK(several.low->at == alone.low->at);
    CHECK(several.high->measure.low == alone.high->measure.low);
    CHECK(several.best->measure.estimate == alone.best->measure.estimate);
}

TEST_CASE("solving can be stopped, and keeps what is known") {
    SolveOptions options = to(1e-12);
    int steps = 0;
    options.progress = [&](const SolveProgress& p) {
        CHECK(p.share >= 0);
        CHECK(p.share <= 1);
        steps += p.low && p.high ? 1 : 0;
    };
    options.cancelled = [&] { return steps > 5; };
    const SolveResult r = solve(ball, {{{first, 1}}, 5}, 0.5, 1.7, options);
    CHECK(r.end == SolveEnd::cancelled);
    CHECK(r.has_bracket());
    options.cancelled = {};
    options.seconds = 0.2;
    CHECK(solve(ball, {{{first, 1}}, 5}, 0.5, 1.7, options).end == SolveEnd::seconds);
}

TEST_CASE("bad input is rejected") {
    const auto rejects = [](const SolveTarget& target, double low, double high, const SolveOptions& options,
                            const char* words) {
        CHECK_THROWS_WITH_AS(solve(ball, target, low, high, options), doctest::Contains(words), ModelError);
    };
    const SolveTarget target{{{first, 1}}, 1};
    rejects(target, 1, 0.5, {}, "the lower one first");
    rejects(target, 1, 1, {}, "the lower one first");
    rejects(target, std::nan(""), 1, {}, "two finite numbers");
    rejects(target, 0, INFINITY, {}, "two finite numbers");
    rejects({{{first, 1}}, std::nan("")}, 0.5, 1, {}, "the target must be a finite number");
    rejects({{{vacuum, 1}}, 1}, 0.5, 1, {}, "the vacuum has no volume");
    rejects({{{first, -1}}, 1}, 0.5, 1, {}, "must not be negative or infinite");
    rejects({{{first, 0}}, 1}, 0.5, 1, {}, "no phase has a positive weight");
    rejects({{}, 1}, 0.5, 1, {}, "no phase has a positive weight");
    rejects(target, 0.5, 1, to(-1), "the width of the bracket");
    SolveOptions no_time;
    no_time.seconds = 0;
    rejects(target, 0.5, 1, no_time, "the time must be a positive number");
    rejects(target, -1, 1, {}, "radius");
}

}  // namespace test_solve
