#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "lanes.hpp"
#include "phasetree/embree.hpp"

namespace phasetree::embree {

struct TreeGeometry::Data {
    std::shared_ptr<const InterfaceCells> object;
};

namespace {

const TreeGeometry::Data& data_of(void* user) {
    return *static_cast<const TreeGeometry::Data*>(user);
}

void bounds(const RTCBoundsFunctionArguments* arguments) {
    const Bounds b = data_of(arguments->geometryUserPtr).object->bounds(arguments->primID);
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = b.low.x;
    out.lower_y = b.low.y;
    out.lower_z = b.low.z;
    out.upper_x = b.high.x;
    out.upper_y = b.high.y;
    out.upper_z = b.high.z;
}

/// As cells see a ray. Its direction may have any length.
Query::Seen seen_as(const RTCRay& ray) {
    Query::Seen s{{ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, 0, {}};
    s.length = LaneRay::length_of(s.origin, s.direction);
    if (s.length > 0) s.ray = TracedRay(s.origin, LaneRay::unit(s.direction, s.length));
    return s;
}

/// The first crossing in a cell, no farther than tfar.
std::optional<Crossing> crossing(const InterfaceCells& object, unsigned cell, const Query::Seen& s, const RTCRay& ray,
                                 std::optional<Phase> carried, const std::optional<LeavingHint>& leaving_hint,
                                 TraceCounters& counters) {
    const float near = ray.tnear * s.length, far = ray.tfar * s.length;
    std::optional<Crossing> c;
    if (!(near <= far)) return c;
    c = object.first_crossing(cell, s.ray, near, far, carried, leaving_hint, counters);
    if (c && !(c->t_in <= far)) c.reset();  // it was so but for rounding
    return c;
}

/// Of a ray that comes with a query, which keeps it from cell to cell, and alone.
template <class Arguments>
std::optional<Crossing> crossing(const Arguments& arguments, Query& query, const RTCRay& ray) {
    Query::Seen& s = query.seen;
    if (std::memcmp(&s.origin, &ray.org_x, sizeof s.origin) != 0 ||
        std::memcmp(&s.direction, &ray.dir_x, sizeof s.direction) != 0)
        s = seen_as(ray);
    std::optional<LeavingHint> leaving_hint;
    const Query::Start& start = query.start;
    if (start.cell == arguments.primID && start.geometry == arguments.geomID &&
        start.instance == arguments.context->instID[0] && ray.tnear == 0) {
        const float along = glm::dot(start.gradient, s.ray.direction);
        leaving_hint = LeavingHint{query.carried == start.from ? -along : along};
    }
    return crossing(*data_of(arguments.geometryUserPtr).object, arguments.primID, s, ray, query.carried, leaving_hint,
                    query.counters);
}
Query& query_of(Context* context) {
    return *reinterpret_cast<Query*>(context);
}

void write(RTCHitN* hits, unsigned n, unsigned i, const Crossing& c, const glm::vec3& normal,
           const RTCIntersectFunctionNArguments& arguments) {
    RTCHitN_Ng_x(hits, n, i) = normal.x;
    RTCHitN_Ng_y(hits, n, i) = normal.y;
    RTCHitN_Ng_z(hits, n, i) = normal.z;
    RTCHitN_u(hits, n, i) = static_cast<float>(c.from.index);
    RTCHitN_v(hits, n, i) = static_cast<float>(c.to.index);
    set_place(hits, n, i, arguments.primID, arguments.geomID, *arguments.context);
}

/// The same, and nothing where there is no memory for it, which the query then knows.
template <class Arguments>
std::optional<Crossing> crossing_if_possible(const Arguments& arguments, Query& query, const RTCRay& ray) noexcept {
    try {
        return crossing(arguments, query, ray);
    } catch (const std::bad_alloc&) {
        query.is_out_of_memory = true;
        return std::nullopt;
    }
}

void intersect_query(const RTCIntersectFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1) return;
    Query& query = query_of(arguments->context);
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
    const auto c = crossing_if_possible(*arguments, query, ray);
    if (!c) return;
    ray.tfar = c->t_in / query.seen.length;
    write(RTCRayHitN_HitN(arguments->rayhit, 1), 1, 0, *c, -query.seen.ray.direction, *arguments);
    query.crossing = *c;
}

void occluded_query(const RTCOccludedFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1) return;
    RTCRay& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
    if (crossing_if_possible(*arguments, query_of(arguments->context), ray))
        ray.tfar = -std::numeric_limits<float>::infinity();
}

/// Calls hit(lane, crossing, the ray as seen) for the lanes of a packet whose ray crosses an interface in the cell; for
/// no more of them where memory ends.
template <class Arguments, class Hit>
void each_crossing(const Arguments& arguments, RTCRayN* rays, Hit&& hit) noexcept try {
    const unsigned n = arguments.N;
    TraceCounters unused;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments.valid[i] != -1) continue;
        const RTCRay ray = rtcGetRayFromRayN(rays, n, i);
        const Query::Seen s = seen_as(ray);
        const InterfaceCells& object = *data_of(arguments.geometryUserPtr).object;
        if (const auto c = crossing(object, arguments.primID, s, ray, {}, {}, unused)) hit(i, *c, s);
    }
} catch (const std::bad_alloc&) {
}

void intersect_lanes(const RTCIntersectFunctionNArguments* arguments) noexcept {
    const unsigned n = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, n);
    each_crossing(*arguments, rays, [&](unsigned i, const Crossing& c, const Query::Seen& s) {
        const InterfaceCells& object = *data_of(arguments->geometryUserPtr).object;
        const glm::vec3 normal = -object.normal(arguments->primID, c, s.ray.direction).unit;
        RTCRayN_tfar(rays, n, i) = c.t_in / s.length;
        write(RTCRayHitN_HitN(arguments->rayhit, n), n, i, c, normal, *arguments);
    });
}

void occluded_lanes(const RTCOccludedFunctionNArguments* arguments) noexcept {
    each_crossing(*arguments, arguments->ray, [&](unsigned i, const Crossing&, const Query::Seen&) {
        RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
    });
}

}  // namespace

TreeGeometry::TreeGeometry(RTCDevice device, std::shared_ptr<const InterfaceCells> object, const Options& options)
    : handle_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER)), data_(std::make_unique<Data>(Data{std::move(object)})) {
    rtcSetGeometryUserPrimitiveCount(handle_, static_cast<unsigned>(data_->object->size()));
    rtcSetGeometryUserData(handle_, data_.get());
    rtcSetGeometryBoundsFunction(handle_, bounds, nullptr);
    rtcSetGeometryIntersectFunction(handle_, options.rays_carry_phases ? intersect_query : intersect_lanes);
    rtcSetGeometryOccludedFunction(handle_, options.rays_carry_phases ? occluded_query : occluded_lanes);
}

TreeGeometry::~TreeGeometry() {
    if (handle_) rtcReleaseGeometry(handle_);
}

TreeGeometry::TreeGeometry(TreeGeometry&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), data_(std::move(other.data_)) {}

TreeGeometry& TreeGeometry::operator=(TreeGeometry&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(data_, other.data_);
    return *this;
}

const InterfaceCells& TreeGeometry::object() const {
    return *data_->object;
}

}  // namespace phasetree::embree
