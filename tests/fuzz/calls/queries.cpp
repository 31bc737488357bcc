// Queries the scenes with rays, packets of rays, and points.
#include <cmath>
#include <limits>
#include <vector>

#include "fuzz/calls/calls.hpp"

namespace phasetree::fuzz {

// A query's context; the phases that its one ray, or all of a packet, carry.
struct QueryContext {
    PhasetreeCarriedPhase carried[2]{};
    PhasetreeRay rays[8]{};
    PhasetreeRayContext extended;
};

namespace {

#if RTC_VERSION_MAJOR >= 4
template <class F>
void with(PhasetreeRayContext& context, F&& f) {
    RTCIntersectArguments a;
    rtcInitIntersectArguments(&a);
    a.context = &context.context;
    f(&a);
}
template <class F>
void with_occluded(PhasetreeRayContext& context, F&& f) {
    RTCOccludedArguments a;
    rtcInitOccludedArguments(&a);
    a.context = &context.context;
    f(&a);
}
void intersect(RTCScene s, PhasetreeRayContext& context, RTCRayHit& r) {
    with(context, [&](auto* a) { rtcIntersect1(s, &r, a); });
}
void occlude(RTCScene s, PhasetreeRayContext& context, RTCRay& r) {
    with_occluded(context, [&](auto* a) { rtcOccluded1(s, &r, a); });
}
void intersect(RTCScene s, PhasetreeRayContext& context, const int* valid, RTCRayHit8& r) {
    with(context, [&](auto* a) { rtcIntersect8(valid, s, &r, a); });
}
#else
void intersect(RTCScene s, PhasetreeRayContext& context, RTCRayHit& r) {
    rtcIntersect1(s, &context.context, &r);
}
void occlude(RTCScene s, PhasetreeRayContext& context, RTCRay& r) {
    rtcOccluded1(s, &context.context, &r);
}
void intersect(RTCScene s, PhasetreeRayContext& context, const int* valid, RTCRayHit8& r) {
    rtcIntersect8(valid, s, &context.context, &r);
}
#endif

}  // namespace

float Calls::finite() {
    const float v = c_.number();
    return std::abs(v) < 1e18f ? v : 0;
}

RTCRay Calls::ray() {
    RTCRay r{};
    r.org_x = finite(), r.org_y = finite(), r.org_z = finite();
    r.dir_x = finite(), r.dir_y = finite(), r.dir_z = finite();
    r.tnear = c_.below(3) == 0 ? std::abs(finite()) : 0;
    r.tfar = c_.below(3) == 0 ? finite() : std::numeric_limits<float>::infinity();
    r.time = c_.below(3) == 0 ? static_cast<float>(c_.byte()) / 255 : 0;
    r.mask = ~0u;
    return r;
}

void Calls::prepare(QueryContext& context) {
    phasetreeInitRayContext(&context.extended);
    for (PhasetreeCarriedPhase& m : context.carried)
        m = {c_.below(4), c_.below(2) == 0 ? RTC_INVALID_GEOMETRY_ID : 0u,
             c_.below(2) == 0 ? RTC_INVALID_GEOMETRY_ID : 0u,
             c_.rarely()   ? PHASETREE_UNKNOWN_PHASE
             : c_.rarely() ? c_.byte()
                           : c_.below(4)};
    for (PhasetreeRay& r : context.rays) {
        r.carried = context.carried;
        r.carriedCount = c_.below(3);
    }
    const unsigned carried = c_.below(4);
    context.extended.rays = carried == 0 ? nullptr : context.rays;
    context.extended.rayCount = carried == 0 ? 0 : carried == 1 ? 1 : 8;
    if (c_.rarely()) context.extended.filter = reject_some;
}

void Calls::trace_one() {
    const Stage& s = stage();
    if (!s.is_committed) return;
    QueryContext context;
    prepare(context);
    RTCRayHit r{};
    r.ray = ray();
    r.hit.geomID = r.hit.primID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    const float far = r.ray.tfar;
    intersect(s.scene, context.extended, r);
    if (r.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        promised(r.ray.tfar <= far, "a hit is before the ray's end");
        promised(r.hit.u >= 0 && r.hit.u < PHASETREE_MAX_PHASES && r.hit.v >= 0 && r.hit.v < PHASETREE_MAX_PHASES,
                 "a hit has phases");
        promised(r.hit.u != r.hit.v, "a hit is a change of phase");
    }
    PhasetreeHit decoded;
    const float identity[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    const PhasetreeGeometry of = geometry();
    check_with(of, phasetreeDecodeHit(of, c_.or_null(&r), c_.below(2) == 0 ? nullptr : identity, c_.or_null(&decoded)));
    RTCRay shadow = ray();
    occlude(s.scene, context.extended, shadow);
}

void Calls::trace_packet() {
    const Stage& s = stage();
    if (!s.is_committed) return;
    QueryContext context;
    prepare(context);
    RTCRayHit8 packet{};
    alignas(32) int valid[8];
    for (unsigned i = 0; i < 8; ++i) {
        const RTCRay r = ray();
        packet.ray.org_x[i] = r.org_x, packet.ray.org_y[i] = r.org_y, packet.ray.org_z[i] = r.org_z;
        packet.ray.dir_x[i] = r.dir_x, packet.ray.dir_y[i] = r.dir_y, packet.ray.dir_z[i] = r.dir_z;
        packet.ray.tnear[i] = r.tnear, packet.ray.tfar[i] = r.tfar, packet.ray.time[i] = r.time;
        packet.ray.mask[i] = ~0u, packet.ray.id[i] = c_.below(9);
        packet.hit.geomID[i] = packet.hit.primID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = c_.below(4) == 0 ? 0 : -1;
    }
    intersect(s.scene, context.extended, valid, packet);
    for (unsigned i = 0; i < 8; ++i)
        if (valid[i] == 0)
            promised(packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID, "lanes that are inactive hit nothing");
}

void Calls::ask_point() {
    const PhasetreeGeometry of = geometry();
    const float p[3] = {c_.number(), c_.number(), c_.number()};
    const float time = c_.number();
    unsigned phase = 0;
    float radius = 0, distances[PHASETREE_MAX_PHASES];
    PhasetreeClosest closest;
    const auto error = phasetreeGetPhase(of, c_.or_null(p), time, c_.or_null(&phase), c_.or_null(&radius));
    check_with(of, error);
    if (error == PHASETREE_ERROR_NONE)
        promised(phase < PHASETREE_MAX_PHASES && !(radius < 0), "a point has a phase and an empty ball");
    check_with(of, phasetreeGetDistances(of, c_.or_null(p), time, c_.rarely() ? nullptr : distances));
    check_with(of, phasetreeFindClosestInterface(of, c_.or_null(p), time, c_.number(), c_.rarely() ? c_.number() : 0.5f,
                                                 c_.or_null(&closest)));
}

void Calls::make_mesh() {
    // Few of them are made to the end.
    int asked = 0;
    PhasetreeMeshOptions options;
    phasetreeInitMeshOptions(&options);
    options.spacing = c_.rarely() ? c_.number() : 0.5f;
    options.cancelledUserPtr = &asked;
    options.cancelled = [](void* count) { return ++*static_cast<int*>(count) > 200; };
    int received = 0;
    const auto receive = [](const PhasetreeMesh* mesh, void* count) {
        ++*static_cast<int*>(count);
        for (std::size_t i = 0; i < 3 * mesh->triangleCount; ++i)
            promised(mesh->indices[i] < mesh->vertexCount, "triangles have vertices that there are");
    };
    const auto error = phasetreeMakeGeometryMesh(geometry(), c_.rarely() ? nullptr : &options,
                                                 c_.rarely() ? nullptr : +receive, &received);
    promised(received == (error == PHASETREE_ERROR_NONE ? 1 : 0), "a mesh is handed over once, or there is an error");
}

void Calls::query_scene() {
    const Stage& s = stage();
    if (!s.is_committed) return;
    std::vector<PhasetreePointQueryGeometry> listed;
    for (const auto& [id, place] : s.attached)
        listed.push_back({id, RTC_INVALID_GEOMETRY_ID, geometries_[place].handle});
    PhasetreePointQuery own{};
    own.apiVersion = c_.rarely() ? 7 : PHASETREE_API_VERSION;
    own.geometries = listed.data();
    own.geometryCount = static_cast<unsigned>(listed.size());
    own.tolerance = c_.rarely() ? c_.number() : 0.5f;
    RTCPointQuery query{c_.number(), c_.number(), c_.number(), 0, std::abs(c_.number())};
    if (!(query.radius >= 0) || !std::isfinite(query.x + query.y + query.z)) return;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(s.scene, &query, &context, point_query_ ? nullptr : phasetreePointQueryFunction, &own);
}

}  // namespace phasetree::fuzz
