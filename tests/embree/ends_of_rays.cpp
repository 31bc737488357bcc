// A crossing does not depend on where its ray ends. Embree shortens a ray to each hit that it finds, and in which order
// it visits cells differs from processor to processor.
#include <doctest/doctest.h>

#include <limits>

#include "embree/cell_tracer.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "source_directory.hpp"
#include "support/random_tree.hpp"

namespace test_ends_of_rays {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

bool are_same(const Crossing& a, const Crossing& b) {
    return a.t_in == b.t_in && a.t_out == b.t_out && a.p_in == b.p_in && a.p_out == b.p_out && a.from == b.from &&
           a.to == b.to;
}

}  // namespace

TEST_CASE("a crossing has the same bits wherever behind it the ray ends") {
    const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(nullptr));
    REQUIRE(device);
    Random rng(71);
    int hits = 0, differ = 0, farther = 0;
    for (const char* name : {"cable", "two_pears", "inlaid_spheres"}) {
        const Document document = Document::from_file(source_directory() + "/scenes/" + name + ".json");
        const CellTracer tracer(device.get(), read_tree(document).object, BuildQuality::medium);
        const Bounds bounds = tracer.bounds();
        for (int ray = 0; ray < 2000; ++ray) {
            const glm::vec3 direction = rng.direction(), origin = rng.in(bounds)-bounds.diagonal() * direction;
            TraceCounters counters;
            const float infinity = std::numeric_limits<float>::infinity();
            const auto hit = tracer.first_crossing(origin, direction, infinity, vacuum, nullptr, counters);
            if (!hit) continue;
            ++hits;
            for (int k = 0; k < 4; ++k) {
                const float end = hit->t_out + 0.02f * bounds.diagonal() * rng.uniform(0, 1) * rng.uniform(0, 1);
                const auto other = tracer.first_crossing(origin, direction, end, vacuum, nullptr, counters);
                differ += !other || !are_same(*hit, *other);
            }
            const float before = hit->t_in - 1e-5f * bounds.diagonal();
            farther += tracer.first_crossing(origin, direction, before, vacuum, nullptr, counters).has_value();
        }
    }
    CHECK(hits > 2000);
    CHECK(differ == 0);
    CHECK(farther == 0);
}

}  // namespace test_ends_of_rays
