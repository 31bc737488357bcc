// A PhaseTree in an Embree scene, as seen by an application that knows only Embree. The reference is InterfaceTracer,
// which marches through the object with its whole program.
#include "embree/alone.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_geometry {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a stock context: hits are the tracer's first crossings") {
    const Alone alone;
    const InterfaceTracer tracer(object());
    Evaluator::Workspace workspace;
    int hit = 0;
    for (const Ray& ray : rays(4000, 1)) {
        CAPTURE(ray.origin.x);
        CAPTURE(ray.origin.y);
        CAPTURE(ray.origin.z);
        CAPTURE(ray.direction.x);
        CAPTURE(ray.direction.y);
        CAPTURE(ray.direction.z);
        const RTCRayHit r = intersect(alone.scene, rayhit(ray));
        const auto expected = tracer.first_crossing(ray.origin, ray.direction, 0, 1e30f, std::nullopt, workspace);
        REQUIRE(hits(r) == expected.has_value());
        if (!expected) continue;
        ++hit;
        CHECK(same_place(r.ray.tfar, expected->t_from, tracer.resolution()));
        CHECK(r.hit.u == expected->from.index);
        CHECK(r.hit.v == expected->to.index);
        CHECK(r.hit.geomID == alone.id);
        CHECK(r.hit.primID < alone.tree.cells().size());
        const glm::vec3 normal(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z);
        CHECK(glm::length(normal) == doctest::Approx(1).epsilon(1e-5));
        CHECK(glm::dot(normal, ray.direction) < 0);
    }
    CHECK(hit > 2000);
}

TEST_CASE("normals are the surface's, on the side the ray came from") {
    Device device;
    const Phased ball = Set{.phase = Phase{1}, .of = Sphere{.radius = 2}};
    const embree::CellGeometry tree(device, std::make_shared<const InterfaceCells>(ball));
    EmbreeScene scene(device);
    scene.add(tree.handle());
    scene.commit();
    for (const Ray& ray : rays(500, 2)) {
        const RTCRayHit r = intersect(scene, rayhit(ray));
        REQUIRE((hits(r) || glm::length(ray.origin) > 2));
        if (!hits(r)) continue;
        const glm::vec3 outward = glm::normalize(ray.origin + r.ray.tfar * ray.direction);
        const glm::vec3 expected = glm::length(ray.origin) < 2 ? -outward : outward;
        CHECK(glm::distance(glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z), expected) < 1e-4f);
    }
}

namespace {

// Bit for bit, member by member: Embree 4's RTCHit has padding, which nobody promises.
bool untouched(const RTCRayHit& a, const RTCRayHit& b) {
    const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    const RTCHit &h = a.hit, &k = b.hit;
    return same(a.ray, b.ray) && same(h.Ng_x, k.Ng_x) && same(h.Ng_y, k.Ng_y) && same(h.Ng_z, k.Ng_z) &&
           same(h.u, k.u) && same(h.v, k.v) && h.primID == k.primID && h.geomID == k.geomID &&
           h.instID[0] == k.instID[0];
}

// Rays in packets of N with every third lane inactive: the others are as one by one.
template <int N, class Packet, class Trace>
void check_packets(const Alone& alone, Trace&& trace) {
    CAPTURE(N);
    const float resolution = alone.tree.cells().resolution();
    const std::vector<Ray> all = rays(100 * N, 3);
    for (std::size_t first = 0; first < all.size(); first += N) {
        alignas(64) int valid[N];
        Packet packet{};
        std::vector<RTCRayHit> before;
        RTCRayHitN* const p = reinterpret_cast<RTCRayHitN*>(&packet);
        for (unsigned i = 0; i < N; ++i) {
            valid[i] = i % 3 == 2 ? 0 : -1;
            before.push_back(rayhit(all[first + i]));
            before.back().hit.u = 0.125f;  // to be found again where nothing is hit
            before.back().hit.Ng_x = 0.25f;
            RTCRayN* const r = RTCRayHitN_RayN(p, N);
            RTCHitN* const h = RTCRayHitN_HitN(p, N);
            const RTCRayHit& b = before.back();
            RTCRayN_org_x(r, N, i) = b.ray.org_x, RTCRayN_org_y(r, N, i) = b.ray.org_y;
            RTCRayN_org_z(r, N, i) = b.ray.org_z, RTCRayN_tnear(r, N, i) = b.ray.tnear;
            RTCRayN_dir_x(r, N, i) = b.ray.dir_x, RTCRayN_dir_y(r, N, i) = b.ray.dir_y;
            RTCRayN_dir_z(r, N, i) = b.ray.dir_z, RTCRayN_tfar(r, N, i) = b.ray.tfar;
            RTCRayN_mask(r, N, i) = b.ray.mask;
            RTCHitN_geomID(h, N, i) = b.hit.geomID, RTCHitN_primID(h, N, i) = b.hit.primID;
            RTCHitN_instID(h, N, i, 0) = b.hit.instID[0];
            RTCHitN_u(h, N, i) = b.hit.u, RTCHitN_Ng_x(h, N, i) = b.hit.Ng_x;
        }
        trace(valid, packet);
        for (unsigned i = 0; i < N; ++i) {
            CAPTURE(i);
            RTCRayHit after = rtcGetRayHitFromRayHitN(p, N, i);
            const RTCRayHit alone_one = intersect(alone.scene, before[i]);
            if (valid[i] == 0 || !hits(alone_one)) {
                after.ray.flags = before[i].ray.flags;
                CHECK(untouched(after, before[i]));
                continue;
            }
            CHECK(same_place(after.ray.tfar, alone_one.ray.tfar, resolution));
            CHECK(after.hit.geomID == alone_one.hit.geomID);
            CHECK(after.hit.u == alone_one.hit.u);
            CHECK(after.hit.v == alone_one.hit.v);
        }
    }
}

}  // namespace

TEST_CASE("packets of 4, 8 and 16") {
    const Alone alone;
#if PHASETREE_EMBREE_MAJOR == 4
    check_packets<4, RTCRayHit4>(alone,
                                 [&](int* valid, RTCRayHit4& p) { rtcIntersect4(valid, alone.scene, &p, nullptr); });
    check_packets<8, RTCRayHit8>(alone,
                                 [&](int* valid, RTCRayHit8& p) { rtcIntersect8(valid, alone.scene, &p, nullptr); });
    check_packets<16, RTCRayHit16>(
        alone, [&](int* valid, RTCRayHit16& p) { rtcIntersect16(valid, alone.scene, &p, nullptr); });
#else
    embree::Context context;
    embree::initialise(context);
    check_packets<4, RTCRayHit4>(alone,
                                 [&](int* valid, RTCRayHit4& p) { rtcIntersect4(valid, alone.scene, &context, &p); });
    check_packets<8, RTCRayHit8>(alone,
                                 [&](int* valid, RTCRayHit8& p) { rtcIntersect8(valid, alone.scene, &context, &p); });
    check_packets<16, RTCRayHit16>(
        alone, [&](int* valid, RTCRayHit16& p) { rtcIntersect16(valid, alone.scene, &context, &p); });
#endif
}

TEST_CASE("occluded agrees with intersect, whatever the segment") {
    const Alone alone;
    std::mt19937 random(4);
    const float resolution = alone.tree.cells().resolution();
    for (const Ray& ray : rays(2000, 5)) {
        const RTCRayHit r = intersect(alone.scene, rayhit(ray));
        CHECK(occluded(alone.scene, rayhit(ray)) == hits(r));
        if (!hits(r) || r.ray.tfar < 0.01f) continue;
        CHECK_FALSE(occluded(alone.scene, rayhit(ray, 0, r.ray.tfar - 8 * resolution)));
        CHECK(occluded(alone.scene, rayhit(ray, 0, r.ray.tfar + 8 * resolution)));
        const float far = std::uniform_real_distribution<float>(0, 4)(random);
        if (same_place(far, r.ray.tfar, resolution)) continue;
        CHECK(occluded(alone.scene, rayhit(ray, 0, far)) == (r.ray.tfar < far));
        CHECK(hits(intersect(alone.scene, rayhit(ray, 0, far))) == (r.ray.tfar < far));
        // Behind the hit, the next one.
        const RTCRayHit next = intersect(alone.scene, rayhit(ray, r.ray.tfar + 8 * resolution));
        if (hits(next)) CHECK(next.ray.tfar > r.ray.tfar);
    }
}

TEST_CASE("the length of the direction is the unit of distance and nothing else") {
    const Alone alone;
    const float resolution = alone.tree.cells().resolution();
    for (const Ray& ray : rays(1000, 6)) {
        const RTCRayHit unit = intersect(alone.scene, rayhit(ray));
        for (const float length : {1e-3f, 1e3f}) {
            const RTCRayHit scaled = intersect(alone.scene, rayhit({ray.origin, length * ray.direction}));
            REQUIRE(hits(scaled) == hits(unit));
            if (!hits(unit)) continue;
            CHECK(same_place(scaled.ray.tfar * length, unit.ray.tfar, resolution));
            CHECK(scaled.hit.u == unit.hit.u);
            CHECK(scaled.hit.v == unit.hit.v);
        }
    }
}

TEST_CASE("instances: moved, turned and scaled") {
    Device device;
    const embree::CellGeometry tree(device, std::make_shared<const InterfaceCells>(object()));
    EmbreeScene inner(device), outer(device);
    inner.add(tree.handle());
    inner.commit();
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    // p ↦ 3 (y, −x, z) + (1, 2, 3), by columns
    const float matrix[12] = {0, -3, 0, 3, 0, 0, 0, 0, 3, 1, 2, 3};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    const unsigned id = outer.add(instance);
    outer.commit();
    rtcReleaseGeometry(instance);
    const auto moved = [](const glm::vec3& v) { return 3.0f * glm::vec3(v.y, -v.x, v.z); };
    for (const Ray& ray : rays(1000, 7)) {
        const RTCRayHit here = intersect(inner, rayhit(ray));
        const RTCRayHit there =
            intersect(outer, rayhit({moved(ray.origin) + glm::vec3(1, 2, 3), moved(ray.direction) / 3.0f}));
        REQUIRE(hits(there) == hits(here));
        if (!hits(here)) continue;
        CHECK(same_place(there.ray.tfar / 3, here.ray.tfar, tree.cells().resolution()));
        CHECK(there.hit.instID[0] == id);
        CHECK(there.hit.u == here.hit.u);
        CHECK(there.hit.v == here.hit.v);
    }
}

TEST_CASE("beside a triangle mesh the nearest wins, whichever came first") {
    const float walls[] = {-2, 0.2f, 2};  // planes x = …: before, within and behind the object
    for (const bool mesh_first : {true, false}) {
        for (const float x : walls) {
            Device device;
            const embree::CellGeometry tree(device, std::make_shared<const InterfaceCells>(object()));
            EmbreeScene scene(device);
            const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* const v = static_cast<float*>(
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
            auto* const t = static_cast<unsigned*>(
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 1));
            const float vertices[] = {x, -100, -100, x, 200, -100, x, -100, 200};
            std::memcpy(v, vertices, sizeof vertices);
            t[0] = 0, t[1] = 1, t[2] = 2;
            unsigned mesh_id = 0, tree_id = 0;
            if (mesh_first) mesh_id = scene.add(mesh);
            tree_id = scene.add(tree.handle());
            if (!mesh_first) mesh_id = scene.add(mesh);
            rtcReleaseGeometry(mesh);
            scene.commit();

            const InterfaceTracer tracer(object());
            Evaluator::Workspace workspace;
            for (const Ray& ray : rays(500, 8)) {
                const auto c = tracer.first_crossing(ray.origin, ray.direction, 0, 1e30f, std::nullopt, workspace);
                const float to_tree = c ? c->t_from : infinity;
                const float along = (x - ray.origin.x) / ray.direction.x;
                if (along > 50) continue;  // beyond the triangle
                const float to_mesh = along > 0 ? along : infinity;
                if (std::abs(to_mesh - to_tree) < 1e-4f) continue;
                const RTCRayHit r = intersect(scene, rayhit(ray));
                const unsigned expected = std::min(to_tree, to_mesh) == infinity ? RTC_INVALID_GEOMETRY_ID
                                          : to_mesh < to_tree                    ? mesh_id
                                                                                 : tree_id;
                CHECK(r.hit.geomID == expected);
                if (hits(r)) CHECK(r.ray.tfar == doctest::Approx(std::min(to_tree, to_mesh)).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("geometries move; Embree calls go on") {
    Device device;
    embree::CellGeometry first(device, std::make_shared<const InterfaceCells>(object()));
    embree::CellGeometry second(
        device, std::make_shared<const InterfaceCells>(Phased(Set{.phase = Phase{1}, .of = Sphere{.radius = 0.1f}})));
    embree::CellGeometry moved(std::move(first));
    second = std::move(moved);
    EmbreeScene scene(device);
    scene.add(second.handle());
    scene.commit();
    CHECK(hits(intersect(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
    CHECK(second.cells().size() > 0);
}

}  // namespace test_geometry
