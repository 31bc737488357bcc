// Applications with a user geometry of their own that dispatches between several things, including our geometries.
#include "embree/api/api.hpp"

namespace test_dispatch {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// Primitive 0 and 1 are two trees.
struct Own {
    std::vector<PhasetreeGeometry> parts;
    int filtered = 0;
};

void bounds(const RTCBoundsFunctionArguments* args) {
    phasetreeGetPrimitiveBounds(static_cast<Own*>(args->geometryUserPtr)->parts[args->primID], args);
}
void intersect(const RTCIntersectFunctionNArguments* args) {
    phasetreeIntersectPrimitive(static_cast<Own*>(args->geometryUserPtr)->parts[args->primID], args);
}
void occluded(const RTCOccludedFunctionNArguments* args) {
    phasetreeOccludedPrimitive(static_cast<Own*>(args->geometryUserPtr)->parts[args->primID], args);
}
void count(const RTCFilterFunctionNArguments* args) {
    ++*static_cast<int*>(args->geometryUserPtr);
    args->valid[0] = 0;
}

}  // namespace

TEST_CASE("a geometry that dispatches to two trees") {
    Device device;
    embree::Geometry first(device, object_tree()), second(device, object_tree());
    second.set_motion({{1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0}});
    Own own{{first.get(), second.get()}, 0};
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 2);
    rtcSetGeometryUserData(geometry, &own);
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    EmbreeScene scene(device);
    const unsigned id = scene.add(geometry);
    scene.commit();
    const Placed alone;
    int hit = 0;
    for (const Ray& ray : rays(500, 95)) {
        if (std::abs(ray.direction.x) > 0.3f) continue;  // those see both
        const RTCRayHit expected = trace_one(alone.scene, marked(ray));
        RTCRayHit a = trace_one(scene, marked(ray));
        REQUIRE(occluded_one(scene, marked(ray)) == hits(a));
        if (hits(expected)) {
            ++hit;
            REQUIRE(a.hit.geomID == id);
            a.hit.geomID = expected.hit.geomID;
            REQUIRE(same_bits(a, expected));
        }
        const RTCRayHit b = trace_one(scene, marked({ray.origin + glm::vec3(5, 0, 0), ray.direction}));
        if (hits(expected) && expected.ray.tfar < 3) REQUIRE(hits(b));
    }
    CHECK(hit > 50);

    // Filters of the application's geometry, with the pointers that ours were given.
    int calls = 0;
    first.set_user_data(&calls);
    rtcSetGeometryIntersectFilterFunction(geometry, count);
    rtcCommitGeometry(geometry);
    scene.commit();
    CHECK_FALSE(hits(trace_one(scene, rayhit({{0.01f, -3, 0.02f}, {0, 1, 0}}))));
    CHECK(calls >= 2);
    rtcReleaseGeometry(geometry);
}

}  // namespace test_dispatch
