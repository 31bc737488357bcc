// Impossible resolutions, and objects so far from the origin that few digits remain: the resolution used instead, the
// warning, and that rays still end.
#include <doctest/doctest.h>

#include <limits>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace test_resolution {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Phased ball(const glm::vec3& at = glm::vec3(0)) {
    return Set{.phase = Phase{1}, .of = warped(Translate{at}, Field(Sphere{}))};
}

/// The whole object and its cells are hit by rays towards a ball's inside, at the ball.
void check_hits(const Phased& object, float resolution, const glm::vec3& at, Random& rng) {
    const InterfaceTracer tracer(object, resolution);
    const InterfaceCells cells(object, {.resolution = resolution});
    CHECK(cells.resolution() == tracer.resolution());
    CHECK(cells.warning() == tracer.warning());
    Evaluator::Workspace w;
    for (int n = 0; n < 60; ++n) {
        const glm::vec3 d = rng.direction(), across = rng.direction(), o = at - 5.f * d + 0.2f * across;
        TraceCounters counters;
        auto hit = tracer.first_crossing(o, d, 0, 100, std::nullopt, w, &counters);
        REQUIRE(hit.has_value());
        // Half of a root's slope at such rays, and what coordinates are rounded to.
        const float tolerance = 4 * tracer.resolution() + 1e-6f * glm::length(at);
        REQUIRE(std::abs(glm::length(hit->p_from - at) - 1) < tolerance);
        REQUIRE(hit->t_to - hit->t_from <= 2.75f * tracer.resolution() + tolerance);
        hit.reset();
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto c = cells.first_crossing(i, o, d, 0, hit ? hit->t_from : 100.f, vacuum, w, counters);
            if (c) hit = c;
        }
        REQUIRE(hit.has_value());
        REQUIRE(std::abs(glm::length(hit->p_from - at) - 1) < tolerance);
        REQUIRE(counters.batches < 5000);
    }
}

}  // namespace

TEST_CASE("a resolution that cannot be gives way to the nearest that can, and that is said") {
    Random rng(811);
    const float diagonal = 2 * std::sqrt(3.f);
    for (const float wanted : {1e-45f, 1e-20f, 1e-9f, 1e-7f}) {
        CAPTURE(wanted);
        const TraceableObject t = prepare_to_trace(ball(), wanted);
        CHECK(t.resolution == doctest::Approx(2.5e-7f * diagonal));
        CHECK(t.warning.find("finer than 32-bit coordinates allow") != std::string::npos);
        check_hits(ball(), wanted, glm::vec3(0), rng);
    }
    for (const float wanted : {0.1f, 1.f, 1e10f, std::numeric_limits<float>::infinity()}) {
        CAPTURE(wanted);
        const TraceableObject t = prepare_to_trace(ball(), wanted);
        CHECK(t.resolution == doctest::Approx(0.01f * diagonal));
        CHECK(t.warning.find("too coarse") != std::string::npos);
        check_hits(ball(), wanted, glm::vec3(0), rng);
    }
    for (const float wanted : {0.f, 1e-6f, 1e-4f, 1e-2f}) {
        CAPTURE(wanted);
        const TraceableObject t = prepare_to_trace(ball(), wanted);
        CHECK(t.resolution == (wanted > 0 ? wanted : 2e-6f * diagonal));
        CHECK(t.warning.empty());
        check_hits(ball(), wanted, glm::vec3(0), rng);
    }
}

TEST_CASE("far from the origin an object is traced as finely as coordinates allow, with a warning, and then refused") {
    Random rng(812);
    for (const float far : {10.f, 1e3f, 1e4f, 1e5f, 1e6f}) {
        CAPTURE(far);
        const glm::vec3 at(far, 0, -far);
        const TraceableObject t = prepare_to_trace(ball(at));
        CHECK(t.warning.empty() == (far < 2e3f));
        CHECK(t.resolution >= 2.5e-7f * far);
        check_hits(ball(at), 0, at, rng);
        for (const float wanted : {1e-20f, 1e10f}) {
            CHECK(!prepare_to_trace(ball(at), wanted).warning.empty());
            check_hits(ball(at), wanted, at, rng);
        }
    }
    for (const float far : {1e7f, 1e10f}) {
        try {
            (void)prepare_to_trace(ball({0, far, 0}));
            FAIL("not refused");
        } catch (const ModelError& e) {
            CHECK(std::string(e.what()).find("move it to the origin") != std::string::npos);
        }
    }
}

}  // namespace test_resolution
