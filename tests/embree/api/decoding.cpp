// Decoded hits: both ends of the bracket are in their phases, whichever cell is named.
#include "embree/api/api.hpp"

namespace test_decoding {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a decoded hit's bracket is that of the ray, with its ends in their phases") {
    const Placed stock, carrying(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    const float resolution = stock.geometry.statistics().resolution;
    int hit = 0, differing = 0;
    for (const Ray& ray : rays(4000, 91)) {
        Carrying context{};
        const RTCRayHit r = trace_one(stock.scene, rayhit(ray));
        REQUIRE(hits(trace_one(carrying.scene, rayhit(ray), {.context = &context.context.context})) == hits(r));
        if (!hits(r)) continue;
        ++hit;
        const PhasetreeHit decoded = stock.geometry.decode(r), &told = context.state.hit;
        REQUIRE(decoded.phaseLeft == told.phaseLeft);
        REQUIRE(decoded.phaseEntered == told.phaseEntered);
        REQUIRE(decoded.cell == told.cell);
        REQUIRE(decoded.tIn <= decoded.tOut);
        // The same interface: the phase is certain at both ends, and the bracket short.
        REQUIRE(stock.geometry.phase(arr(vec(decoded.pointIn))) == decoded.phaseLeft);
        REQUIRE(stock.geometry.phase(arr(vec(decoded.pointOut))) == decoded.phaseEntered);
        REQUIRE(decoded.tOut - decoded.tIn < 4.8f * resolution);
        if (!same_place(decoded.tIn, told.tIn, resolution)) ++differing;
    }
    CHECK(hit > 1500);
    CHECK(differing == 0);
}

TEST_CASE("a hit that names another cell is decoded all the same") {
    const Placed placed;
    const auto cells = static_cast<unsigned>(placed.geometry.statistics().cells);
    const float resolution = placed.geometry.statistics().resolution;
    unsigned offset = 1;
    for (const Ray& ray : rays(500, 92)) {
        RTCRayHit r = trace_one(placed.scene, rayhit(ray));
        if (!hits(r)) continue;
        const PhasetreeHit right = placed.geometry.decode(r);
        r.hit.primID = (r.hit.primID + offset++ * 7919) % cells;
        const PhasetreeHit other = placed.geometry.decode(r);
        REQUIRE(other.phaseLeft == right.phaseLeft);
        REQUIRE(other.phaseEntered == right.phaseEntered);
        REQUIRE(same_place(other.tIn, right.tIn, resolution));
        REQUIRE(placed.geometry.phase(arr(vec(other.pointIn))) == other.phaseLeft);
        REQUIRE(placed.geometry.phase(arr(vec(other.pointOut))) == other.phaseEntered);
    }
}

}  // namespace test_decoding
