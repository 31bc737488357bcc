// A change of label is found in few batches if the bounds of curvature along the ray predict where it is.
#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "support/random_tree.hpp"

namespace test_narrowing {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a ray finds where it enters a ball in few batches, because it knows a bound on the distance's curvature") {
    const InterfaceCells cells(Phased(Set{.phase = Phase{1}, .of = Sphere{.radius = 1}}));
    Random rng(3);
    TraceCounters counters;
    Evaluator::Workspace w;
    int crossings = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 from = 3.f * rng.direction(), to = 0.9f * rng.direction();
        std::optional<Crossing> hit;
        for (std::size_t c = 0; c < cells.size() && !hit; ++c)
            hit = cells.first_crossing(c, from, glm::normalize(to - from), 0, 3, vacuum, w, counters);
        crossings += hit.has_value();
    }
    const double batches = static_cast<double>(counters.batches) / crossings;
    MESSAGE(batches, " batches a crossing");
    CHECK(crossings == 2000);
    // 2.04, on every machine: often the first frame determines it. 2.36 if how the distance bends were not asked.
    CHECK(batches < 2.1);
}

TEST_CASE("a bracket that follows from the curvature of the distance holds the crossing") {
    const double radius = 1;
    const InterfaceCells cells(Phased(Set{.phase = Phase{1}, .of = Sphere{.radius = 1}}), {.max_depth = 3});
    Random rng(5);
    TraceCounters counters;
    Evaluator::Workspace w;
    int crossings = 0, outside = 0, wide = 0;
    const auto check = [&](const glm::vec3& from, const glm::vec3& to, Phase carried) {
        const glm::vec3 direction = glm::normalize(to - from);
        std::optional<Crossing> hit;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto one = cells.first_crossing(c, from, direction, 0, hit ? hit->t_from : 4.f, carried, w, counters);
            if (one && (!hit || one->t_from < hit->t_from)) hit = one;
        }
        if (!hit) return;
        // Of |o + t·d| = r, in double.
        const glm::dvec3 o(from), d(direction);
        const double b = glm::dot(o, d), c = glm::dot(o, o) - radius * radius, a = glm::dot(d, d);
        const double root = (carried == vacuum ? -b - std::sqrt(b * b - a * c) : -b + std::sqrt(b * b - a * c)) / a;
        // A float's place is off by its rounding, all the farther along the ray the more it grazes.
        const double rounding = 4e-7 * radius / std::sqrt(std::max(b * b / a - c, 1e-3));
        ++crossings;
        outside +=
            root < static_cast<double>(hit->t_from) - rounding || root > static_cast<double>(hit->t_to) + rounding;
        wide += hit->t_to - hit->t_from > cells.resolution() * 1.01f + 1e-6f;
    };
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 from = 3.f * rng.direction(), inside = 0.7f * rng.direction(), to = 0.99f * rng.direction();
        check(from, to, vacuum);
        check(inside, inside + rng.direction(), Phase{1});
    }
    MESSAGE(crossings, " crossings, ", outside, " outside their brackets, ", wide, " too wide; ",
            static_cast<double>(counters.batches) / crossings, " batches a crossing");
    CHECK(crossings == 40'000);
    CHECK(outside == 0);
    CHECK(wide == 0);
}

}  // namespace test_narrowing
