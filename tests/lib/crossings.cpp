// Tracing of whole programs against analytic roots: see support/crossing_checks.hpp.
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/crossing_checks.hpp"

namespace test_crossings {

using namespace phasetree;
using namespace phasetree::tests;
using namespace phasetree::tests::traced;

namespace {

struct WholeTracer {
    using Hit = Crossing;
    const InterfaceTracer& whole;

    std::optional<Hit> first_crossing(const glm::vec3& o, const glm::vec3& d, float length, Phase carried, const Hit*,
                                      TraceCounters& counters) const {
        return whole.first_crossing(o, d, 0, length, carried, Evaluator::thread_workspace(), &counters);
    }
    glm::vec3 normal(const Hit& hit, const glm::vec3& d) const { return whole.normal(hit, d); }
    Phase label(const glm::vec3& p) const { return whole.label(p, Evaluator::thread_workspace()); }
    Bounds bounds() const { return whole.bounds(); }
    float resolution() const { return whole.resolution(); }
};

}  // namespace

TEST_CASE("every interface along a ray is found, once, where it is") {
    Totals totals;
    std::vector<std::string> complaints;
    trace_scenes(
        91, long_tests() ? 4000 : 200, 250,
        [](const Phased&, const InterfaceTracer& whole) { return WholeTracer{whole}; },
        [](Random& rng, const Scene& scene, const InterfaceTracer& whole, const WholeTracer&) {
            return random_probe(rng, scene, whole);
        },
        totals, complaints);
    check_totals(totals, complaints);
}

}  // namespace test_crossings
