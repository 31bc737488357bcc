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
        REQUIRE(decoded.from == told.from);
        REQUIRE(decoded.to == told.to);
        REQUIRE(decoded.cell == told.cell);
        REQUIRE(decoded.tFrom <= decoded.tTo);
        // The same interface: the phase is certain at both ends, and the bracket short.
        REQUIRE(stock.geometry.phase(arr(vec(decoded.pointFrom))) == decoded.from);
        REQUIRE(stock.geometry.phase(arr(vec(decoded.pointTo))) == decoded.to);
        REQUIRE(decoded.tTo - decoded.tFrom < 4.8f * resolution);
        if (!same_place(decoded.tFrom, told.tFrom, resolution)) ++differing;
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
        REQUIRE(other.from == right.from);
        REQUIRE(other.to == right.to);
        REQUIRE(same_place(other.tFrom, right.tFrom, resolution));
        REQUIRE(placed.geometry.phase(arr(vec(other.pointFrom))) == other.from);
        REQUIRE(placed.geometry.phase(arr(vec(other.pointTo))) == other.to);
    }
}

}  // namespace test_decoding
