// Beside triangle meshes the nearest hit wins, whichever geometry came first; masks, and geometries switched off.
#include "embree/api/api.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_beside_meshes {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// A large triangle in the plane x = at.
RTCGeometry wall(RTCDevice device, float at) {
    const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const float vertices[] = {at, -100, -100, at, 200, -100, at, -100, 200};
    const unsigned triangle[] = {0, 1, 2};
    std::memcpy(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3), vertices,
                sizeof vertices);
    std::memcpy(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 1), triangle,
                sizeof triangle);
    return mesh;
}

}  // namespace

TEST_CASE("the nearest wins, whichever came first") {
    for (const bool mesh_first : {true, false}) {
        for (const float x : {-2.0f, 0.2f, 2.0f}) {  // before, within and behind the object
            CAPTURE(mesh_first);
            CAPTURE(x);
            Device device;
            const embree::Geometry geometry(device, object_tree());
            EmbreeScene scene(device);
            const RTCGeometry mesh = wall(device, x);
            unsigned mesh_id = 0, tree_id = 0;
            if (mesh_first) mesh_id = scene.add(mesh);
            tree_id = scene.add(geometry.embree());
            if (!mesh_first) mesh_id = scene.add(mesh);
            rtcReleaseGeometry(mesh);
            scene.commit();
            const InterfaceTracer tracer(object());
            Evaluator::Workspace workspace;
            int of_tree = 0, of_mesh = 0;
            for (const Ray& ray : rays(500, 8)) {
                const auto c = tracer.first_crossing(ray.origin, ray.direction, 0, 1e30f, std::nullopt, workspace);
                const float to_tree = c ? c->t_from : infinity;
                const float along = (x - ray.origin.x) / ray.direction.x;
                if (along > 50) continue;  // beyond the triangle
                const float to_mesh = along > 0 ? along : infinity;
                if (std::abs(to_mesh - to_tree) < 1e-4f) continue;
                const RTCRayHit r = trace_one(scene, rayhit(ray));
                const unsigned expected = std::min(to_tree, to_mesh) == infinity ? RTC_INVALID_GEOMETRY_ID
                                          : to_mesh < to_tree                    ? mesh_id
                                                                                 : tree_id;
                REQUIRE(r.hit.geomID == expected);
                REQUIRE(occluded_one(scene, rayhit(ray)) == hits(r));
                if (!hits(r)) continue;
                ++(expected == tree_id ? of_tree : of_mesh);
                REQUIRE(r.ray.tfar == doctest::Approx(std::min(to_tree, to_mesh)).epsilon(1e-4));
            }
            CHECK(of_tree > 50);
            CHECK(of_mesh > 50);
        }
    }
}

TEST_CASE("masks: a ray sees a geometry that shares a bit with it") {
    Placed placed;
    REQUIRE(rtcGetDeviceProperty(placed.device, RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 1);
    rtcSetGeometryMask(placed.geometry.embree(), 0b0110);
    rtcCommitGeometry(placed.geometry.embree());
    placed.scene.commit();
    RTCRayHit ray = marked({{0, -3, 0}, {0, 1, 0}});
    for (unsigned mask = 0; mask < 16; ++mask) {
        CAPTURE(mask);
        ray.ray.mask = mask;
        const RTCRayHit r = trace_one(placed.scene, ray);
        CHECK(hits(r) == ((mask & 0b0110) != 0));
        CHECK(occluded_one(placed.scene, ray) == hits(r));
        if (!hits(r)) CHECK(same_bits(r, ray));
    }
    // Lanes of a packet, each with its own.
    RTCRayHit16 packet{};
    alignas(64) int valid[16];
    for (unsigned i = 0; i < 16; ++i) {
        valid[i] = -1;
        ray.ray.mask = i;
        put<16>(packet, i, ray);
    }
    query<16>(placed.scene, valid, packet, {});
    for (unsigned i = 0; i < 16; ++i) CHECK(hits(get<16>(packet, i)) == ((i & 0b0110) != 0));
}

TEST_CASE("disabled, enabled, detached and attached again") {
    Placed placed;
    const RTCRayHit ray = rayhit({{0, -3, 0}, {0, 1, 0}});
    CHECK(hits(trace_one(placed.scene, ray)));
    rtcDisableGeometry(placed.geometry.embree());
    placed.scene.commit();
    CHECK_FALSE(hits(trace_one(placed.scene, ray)));
    rtcEnableGeometry(placed.geometry.embree());
    placed.scene.commit();
    CHECK(hits(trace_one(placed.scene, ray)));
    rtcDetachGeometry(placed.scene, placed.id);
    placed.scene.commit();
    CHECK_FALSE(hits(trace_one(placed.scene, ray)));
    rtcAttachGeometryByID(placed.scene, placed.geometry.embree(), 7);
    placed.scene.commit();
    const RTCRayHit again = trace_one(placed.scene, ray);
    CHECK(again.hit.geomID == 7);
    // In two scenes at once.
    EmbreeScene second(placed.device);
    second.add(placed.geometry.embree());
    second.commit();
    CHECK(hits(trace_one(second, ray)));
    CHECK(hits(trace_one(placed.scene, ray)));
}

}  // namespace test_beside_meshes
