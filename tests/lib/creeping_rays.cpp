// Rays along faces, edges, seams and lines of solids of every kind, through whole programs: see
// support/creeping_rays.hpp.
#include "support/creeping_rays.hpp"

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_creeping_rays {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct WholeTracer {
    using Hit = Crossing;
    InterfaceTracer whole;

    std::optional<Hit> first_crossing(const glm::vec3& o, const glm::vec3& d, float length, Phase carried, const Hit*,
                                      TraceCounters& counters) const {
        return whole.first_crossing(o, d, 0, length, carried, Evaluator::thread_workspace(), &counters);
    }
    Phase label(const glm::vec3& p) const { return whole.label(p, Evaluator::thread_workspace()); }
    Bounds bounds() const { return whole.bounds(); }
    float resolution() const { return whole.resolution(); }
};

}  // namespace

TEST_CASE("a ray that creeps along a surface misses nothing of what lies behind it") {
    creeping::Totals totals;
    creeping::trace_along_lines(
        211, long_tests() ? 400 : 12, [](const Phased& a) { return WholeTracer{InterfaceTracer(a)}; }, totals);
    creeping::check_totals(totals);
}

}  // namespace test_creeping_rays
