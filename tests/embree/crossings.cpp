// Tracing through Embree and cells against analytic roots: see support/crossing_checks.hpp. A ninth of the rays run
// along faces of cells, where two cells have to agree.
#include <filesystem>

#include "embree/cell_tracer.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "source_directory.hpp"
#include "support/crossing_checks.hpp"

namespace test_crossings {

using namespace phasetree;
using namespace phasetree::tests;
using namespace phasetree::tests::traced;

namespace {

/// Along a face of a cell, or along one of its edges.
Probe along_a_face(Random& rng, const InterfaceCells& cells) {
    const Bounds box = cells.bounds(static_cast<std::size_t>(rng.below(static_cast<int>(cells.size()))));
    glm::vec3 p = rng.in(box), d = rng.direction();
    const int axis = rng.below(3);
    p[axis] = rng.chance(0.5) ? box.low[axis] : box.high[axis];
    d[axis] = 0;
    if (rng.chance(0.3)) {
        const int other = (axis + 1 + rng.below(2)) % 3;
        p[other] = rng.chance(0.5) ? box.low[other] : box.high[other];
        d[other] = 0;
    }
    if (glm::length(d) == 0) d[(axis + 1) % 3] = 1;
    d = glm::normalize(d);
    // So far that the sum is rounded less than half a resolution.
    return {p - rng.uniform(0, 1) * cells.bounds().diagonal() * d, d, "along a cell's face"};
}

}  // namespace

TEST_CASE("through Embree and cells, every interface along a ray is found, once, where it is") {
    const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(nullptr));
    REQUIRE(device);
    Totals totals;
    std::vector<std::string> complaints;
    std::size_t scenes = 0;
    trace_scenes(
        17, long_tests() ? 4000 : 200, 250,
        [&](const Phased& object, const InterfaceTracer&) {
            return CellTracer(device.get(), object, ++scenes % 3 == 0 ? BuildQuality::low : BuildQuality::medium);
        },
        [](Random& rng, const Scene& scene, const InterfaceTracer& whole, const CellTracer& tracer) {
            if (tracer.cells().size() > 0 && rng.chance(1.0 / 9)) return along_a_face(rng, tracer.cells());
            return random_probe(rng, scene, whole);
        },
        totals, complaints);
    check_totals(totals, complaints);
    MESSAGE(totals.batches_knowing, " batches of rays that leave and know how, ", totals.batches_unknowing, " else");
    // 0.911 of them; 0.946 by the cell's linear bound alone, if how they leave counts for nothing.
    CHECK(static_cast<double>(totals.batches_knowing) < 0.93 * static_cast<double>(totals.batches_unknowing));
}

TEST_CASE("a ray that starts at an interface meets nothing before its start") {
    // A ray out of the whisky in its cut glass, as a path found it: by rounding the crossing was 10⁻¹³ before the
    // start.
    const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(nullptr));
    REQUIRE(device);
    const auto file = std::filesystem::path(source_directory()) / "scenes" / "drinks_in_the_sun.json";
    const SceneTree tree = read_tree(Document::from_file(file));
    const CellTracer tracer(device.get(), tree.object, BuildQuality::medium);
    const glm::vec3 origin(-0x1.45647ep-1f, -0x1.f09ba8p-6f, 0x1.53301ep-1f);
    const glm::vec3 direction(-0x1.ffdfe4p-4f, -0x1.75b642p-1f, -0x1.5813dep-1f);
    TraceCounters counters;
    const auto hit = tracer.first_crossing(origin, direction, 100, Phase{2}, nullptr, counters);
    REQUIRE(hit);
    CHECK(hit->t_from == 0);
    CHECK(hit->t_to > 0);
    CHECK(hit->t_to < 1e-4f);
}

}  // namespace test_crossings
