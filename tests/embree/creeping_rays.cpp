// Rays along faces, edges, seams and lines of solids of every kind, through Embree and cells: see
// support/creeping_rays.hpp.
#include "support/creeping_rays.hpp"

#include "embree/cell_tracer.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"

namespace test_creeping_rays {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("through Embree and cells, too, a ray that creeps along a surface misses nothing of what lies behind it") {
    const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(nullptr));
    REQUIRE(device);
    creeping::Totals totals;
    creeping::trace_along_lines(
        212, long_tests() ? 100 : 2, [&](const Phased& a) { return CellTracer(device.get(), a, BuildQuality::low); },
        totals);
    creeping::check_totals(totals);
}

}  // namespace test_creeping_rays
