// Estimates of areas from lines: agreement with closed forms, when they stop, and what they report.
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>

#include "phasetree/measuring/areas.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_measure_areas {

using namespace phasetree;

namespace {

constexpr double pi = 3.141592653589793;
constexpr Phase first{1}, second{2};

// The crossings of a ball about the origin.
LineTracer ball(double radius) {
    return [=](const glm::vec3& origin, const glm::vec3& direction, float, std::vector<CrossingOnLine>& found) {
        const glm::dvec3 o(origin), d(direction);
        const double b = glm::dot(o, d), root = b * b - glm::dot(o, o) + radius * radius;
        if (!(root > 0)) return;
        found.push_back({static_cast<float>(-b - std::sqrt(root)), vacuum, first});
        found.push_back({static_cast<float>(-b + std::sqrt(root)), first, vacuum});
    };
}

const Bounds bounds{{-4, -3, -2}, {4, 3, 2}};

}  // namespace

TEST_CASE("lines are traced until they have met something") {
    const double radius = 0.1, area = 4 * pi * radius * radius;
    const AreaResult few = estimate_areas(bounds, ball(radius), {.tolerance = 0.25, .max_lines = 1});
    CHECK(few.lines == 2048);
    CHECK(few.phases.empty());
    CHECK_FALSE(few.is_within_tolerance);
    const AreaResult enough = estimate_areas(bounds, ball(radius), {.tolerance = 0.25});
    CHECK(enough.is_within_tolerance);
    REQUIRE(enough.phases.size() == 1);
    CHECK(enough.phases[0].standard_error <= 0.25 * enough.phases[0].area);
    CHECK(std::abs(enough.phases[0].area - area) < 4 * enough.phases[0].standard_error);
}

TEST_CASE("more lines make areas more precise, and the error is no larger than the standard error says") {
    const double area = 4 * pi * 2.25;
    double before = area;
    for (const std::size_t lines : {std::size_t{1} << 12, std::size_t{1} << 16, std::size_t{1} << 20}) {
        const AreaResult r = estimate_areas(bounds, ball(1.5), {.tolerance = 1e-9, .max_lines = lines});
        CHECK(r.lines == lines);
        CHECK_FALSE(r.is_within_tolerance);
        REQUIRE(r.phases.size() == 1);
        REQUIRE(r.contacts.size() == 1);
        CHECK(r.contacts[0].area == r.phases[0].area);
        CHECK(std::abs(r.phases[0].area - area) < 4 * r.phases[0].standard_error);
        CHECK(r.phases[0].standard_error < 0.5 * before);
        // Independent lines that meet the ball with this probability would have a larger one.
        const double radius = 0.5 * glm::length(glm::dvec3(bounds.extent())), share = 2.25 / (radius * radius);
        CHECK(r.phases[0].standard_error < 1.2 * area * std::sqrt((1 - share) / (share * static_cast<double>(lines))));
        before = r.phases[0].standard_error;
    }
}

TEST_CASE("a cancelled estimate is that of fewer lines") {
    std::atomic<int> polls{0};
    AreaOptions options{.tolerance = 1e-9};
    options.cancelled = [&] { return ++polls > 1000; };
    const AreaResult cancelled = estimate_areas(bounds, ball(1.5), options);
    CHECK(cancelled.lines < options.max_lines);
    REQUIRE(cancelled.phases.size() == 1);
    const AreaResult again = estimate_areas(bounds, ball(1.5), {.tolerance = 1e-9, .max_lines = cancelled.lines});
    CHECK(again.lines == cancelled.lines);
    CHECK(again.phases.at(0).area == cancelled.phases[0].area);
    CHECK(again.phases.at(0).standard_error == cancelled.phases[0].standard_error);

    options.cancelled = [] { return true; };
    const AreaResult none = estimate_areas(bounds, ball(1.5), options);
    CHECK(none.lines == 2048);  // which are so few that they are always traced
    CHECK_FALSE(none.is_within_tolerance);
}

TEST_CASE("areas of phases and contacts are within a few standard errors of closed forms") {
    // A ball whose lower half is replaced by a block around it.
    const Phased object =
        Under{.of = {Set{.phase = first, .of = Sphere{.radius = 1}},
                     Set{.phase = second, .of = warped(Translate{.by = {0, 0, -1}}, Box{.size = {3, 3, 2}})}}};
    const InterfaceTracer tracer(object);
    const LineTracer lines = line_tracer(tracer);
    const AreaOptions options{.tolerance = 0.02};
    const AreaResult found = estimate_areas(tracer.bounds(), lines, options);
    const auto is_right = [](const EstimatedArea& a, double area) {
        return std::abs(a.area - area) < 5 * a.standard_error + 1e-6 && a.standard_error < 0.05 * area;
    };
    CHECK(found.is_within_tolerance);
    REQUIRE(found.phases.size() == 2);
    CHECK(is_right(found.phases[0], 3 * pi));
    CHECK(is_right(found.phases[1], 2 * 9 + 4 * 6));
    REQUIRE(found.contacts.size() == 3);
    CHECK(is_right(found.contacts[0], 2 * pi));              // vacuum and the ball
    CHECK(is_right(found.contacts[1], 2 * 9 + 4 * 6 - pi));  // vacuum and the block
    CHECK(is_right(found.contacts[2], pi));                  // ball and block
    CHECK(found.contacts[2].first == first);
    CHECK(found.contacts[2].second == second);

    tbb::task_arena one(1);
    const AreaResult again = one.execute([&] { return estimate_areas(tracer.bounds(), lines, options); });
    CHECK(again.lines == found.lines);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(again.contacts[i].area == found.contacts[i].area);
        CHECK(again.contacts[i].standard_error == found.contacts[i].standard_error);
    }
    CHECK_THROWS_WITH_AS(estimate_areas(Bounds::everything(), lines), doctest::Contains("unbounded"), ModelError);
    CHECK_THROWS_WITH_AS(estimate_areas(tracer.bounds(), lines, {.tolerance = 0}), doctest::Contains("tolerance"),
                         ModelError);
    CHECK_THROWS_WITH_AS(estimate_areas(tracer.bounds(), lines, {.seconds = -1}), doctest::Contains("time"),
                         ModelError);
}

}  // namespace test_measure_areas
