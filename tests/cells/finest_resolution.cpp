// A ray's search ends at any resolution, also at one that is finer than the spacing of floats, which no object is given
// (TraceableObject). Below 10⁻²⁰ of the ray's length not even the growing steps of creeping rays move it.
#include <doctest/doctest.h>

#include "evaluation/assemble.hpp"
#include "kernel/linear_bound.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/model/ray.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"
#include "trace/march.hpp"

namespace test_finest_resolution {

using namespace phasetree;
using namespace phasetree::tests;

using evaluation::assemble, evaluation::Assembly;
using kernel::Curvature, kernel::LinearBound, kernel::Routine, kernel::Visit;
using program::outputs_of;
using trace::first_crossing;

TEST_CASE("a search ends at any resolution") {
    const Phased ball = Set{.phase = Phase{1}, .of = Sphere{}};
    const Program program = record(ball);
    const Assembly assembly = assemble(program.instructions, outputs_of(program));
    const Routine routine = assembly.routine(program.constants.data());
    const LinearBound none;
    Evaluator::Workspace w;
    Random rng(821);
    std::uint64_t most = 0;
    for (const float resolution : {1e-20f, 1e-10f, 1e-7f, 1.f, 1e30f}) {
        CAPTURE(resolution);
        for (int n = 0; n < 4000; ++n) {
            // Through parts of the ball, as in cells: then an end of a bracket comes to lie on the surface itself.
            const glm::vec3 o(rng.uniform(-0.7f, 0.7f), rng.uniform(-0.7f, 0.7f), 5);
            const float top = std::sqrt(1 - o.x * o.x - o.y * o.y);
            const Bounds box{{-1, -1, top - rng.uniform(0.001f, 0.05f)}, {1, 1, top + rng.uniform(0.001f, 0.05f)}};
            const TracedRay ray(o, {0, 0, -1});
            TraceCounters counters;
            const auto hit = first_crossing({.box = &box,
                                             .bound = &none,
                                             .routine = &routine,
                                             .ray = &ray,
                                             .registers = w.registers(assembly.slots),
                                             .curvature = {Curvature::unknown, Curvature::unknown},
                                             .t_min = 0,
                                             .t_max = 100,
                                             .resolution = resolution,
                                             .carried = 0,
                                             .rise = Visit::no_leaving_hint},
                                            counters);
            most = std::max<std::uint64_t>(most, counters.batches);
            if (resolution > 0.01f) continue;  // nothing need be seen
            REQUIRE(hit.has_value());
            REQUIRE(std::abs(hit->t_from - (5 - top)) < 4 * resolution + 2e-6f);
        }
    }
    CHECK(most < 5000);
}

}  // namespace test_finest_resolution
