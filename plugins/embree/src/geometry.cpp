#include <limits>
#include <utility>

#include "lanes.hpp"
#include "phasetree/embree.hpp"

namespace phasetree::embree {

struct TreeGeometry::Data {
    std::shared_ptr<const InterfaceCells> object;
    Options options;
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

struct Lane {
    Crossing crossing;
    glm::vec3 direction;
    float length;
};

/// Where in the scene a callback is asked to look.
struct Where {
    unsigned geometry, cell, instance;
};

/// Makes a query's ray ready, unless it is the one that came last.
const Query::Seen& seen(Query& query, RTCRayN* rays, unsigned n, unsigned i) {
    const glm::vec3 origin{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)};
    const glm::vec3 direction{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)};
    Query::Seen& s = query.seen;
    if (s.origin != origin || s.direction != direction) {
        s = {origin, direction, 0, {}};
        if (const auto ray = LaneRay::of(origin, direction, 0, 0)) {
            s.length = ray->length;
            s.ray = TracedRay(ray->origin, ray->direction);
        }
    }
    return s;
}

std::optional<Lane> trace(const TreeGeometry::Data& data, const Where& where, RTCRayN* rays, unsigned n, unsigned i,
                          Query* query) {
    std::optional<Crossing> crossing;
    if (query) {
        const Query::Seen& s = seen(*query, rays, n, i);
        const float near = RTCRayN_tnear(rays, n, i) * s.length, far = RTCRayN_tfar(rays, n, i) * s.length;
        if (!(near <= far)) return std::nullopt;
        const Query::Start& start = query->start;
        std::optional<Departure> departure;
        if (start.cell == where.cell && start.geometry == where.geometry && start.instance == where.instance &&
            near == 0) {
            const float along = glm::dot(start.gradient, s.ray.direction);
            departure = Departure{query->carried == start.from ? -along : along};
        }
        crossing =
            data.object->first_crossing(where.cell, s.ray, near, far, query->carried, departure, query->counters);
        if (!crossing || !(crossing->t_in <= far)) return std::nullopt;
        return Lane{*crossing, s.ray.direction, s.length};
    }
    const std::optional<LaneRay> ray = LaneRay::of(rays, n, i);
    if (!ray) return std::nullopt;
    TraceCounters unused;
    crossing = data.object->first_crossing(where.cell, TracedRay(ray->origin, ray->direction), ray->near, ray->far,
                                           std::nullopt, std::nullopt, unused);
    if (!crossing || !(crossing->t_in <= ray->far)) return std::nullopt;
    return Lane{*crossing, ray->direction, ray->length};
}

void intersect(const RTCIntersectFunctionNArguments* arguments) noexcept {
    const TreeGeometry::Data& data = data_of(arguments->geometryUserPtr);
    Query* query = data.options.rays_carry_phases ? reinterpret_cast<Query*>(arguments->context) : nullptr;
    const unsigned n = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, n);
    RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, n);
    const Where where{arguments->geomID, arguments->primID, arguments->context->instID[0]};
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const auto lane = trace(data, where, rays, n, i, query);
        if (!lane) continue;
        const Crossing& c = lane->crossing;
        const glm::vec3 normal =
            query ? -lane->direction : -data.object->normal(arguments->primID, c, lane->direction).unit;
        RTCRayN_tfar(rays, n, i) = c.t_in / lane->length;
        RTCHitN_Ng_x(hits, n, i) = normal.x;
        RTCHitN_Ng_y(hits, n, i) = normal.y;
        RTCHitN_Ng_z(hits, n, i) = normal.z;
        RTCHitN_u(hits, n, i) = static_cast<float>(c.from.index);
        RTCHitN_v(hits, n, i) = static_cast<float>(c.to.index);
        set_place(hits, n, i, arguments->primID, arguments->geomID, *arguments->context);
        if (query) query->crossing = c;
    }
}

void occluded(const RTCOccludedFunctionNArguments* arguments) noexcept {
    const TreeGeometry::Data& data = data_of(arguments->geometryUserPtr);
    Query* query = data.options.rays_carry_phases ? reinterpret_cast<Query*>(arguments->context) : nullptr;
    const unsigned n = arguments->N;
    const Where where{arguments->geomID, arguments->primID, arguments->context->instID[0]};
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        if (trace(data, where, arguments->ray, n, i, query))
            RTCRayN_tfar(arguments->ray, n, i) = -std::numeric_limits<float>::infinity();
    }
}

}  // namespace

TreeGeometry::TreeGeometry(RTCDevice device, std::shared_ptr<const InterfaceCells> object, const Options& options)
    : handle_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER)),
      data_(std::make_unique<Data>(Data{std::move(object), options})) {
    rtcSetGeometryUserPrimitiveCount(handle_, static_cast<unsigned>(data_->object->size()));
    rtcSetGeometryUserData(handle_, data_.get());
    rtcSetGeometryBoundsFunction(handle_, bounds, nullptr);
    rtcSetGeometryIntersectFunction(handle_, intersect);
    rtcSetGeometryOccludedFunction(handle_, occluded);
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
