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

/// Where in the scene a callback is asked to look.
struct Where {
    unsigned geometry, cell, instance;
};

/// A ray made ready, unless it is the one that came last.
const Query::Seen& see(Query::Seen& s, RTCRayN* rays, unsigned n, unsigned i) {
    const glm::vec3 origin{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)};
    const glm::vec3 direction{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)};
    if (s.origin != origin || s.direction != direction) {
        s.origin = origin;
        s.direction = direction;
        s.length = LaneRay::length_of(origin, direction);
        s.ray = s.length > 0 ? TracedRay(origin, LaneRay::unit(direction, s.length)) : TracedRay();
    }
    return s;
}

/// What a callback is asked.
struct Asked {
    const TreeGeometry::Data& data;
    Query* query;
    Where where;
    TraceCounters unused{};
    std::optional<Query::Seen> own{};

    template <class Arguments>
    explicit Asked(const Arguments& arguments)
        : data(data_of(arguments.geometryUserPtr)),
          query(data.options.rays_carry_phases ? reinterpret_cast<Query*>(arguments.context) : nullptr),
          where{arguments.geomID, arguments.primID, arguments.context->instID[0]} {}

    /// A lane's ray. Of a query it is kept from cell to cell.
    const Query::Seen& seen(RTCRayN* rays, unsigned n, unsigned i) {
        return see(query ? query->seen : own.emplace(), rays, n, i);
    }
    /// At most `far` away, but for rounding. Returned as it is made: a copy would wait for every number of it.
    std::optional<Crossing> crossing(const Query::Seen& s, float near, float far) {
        std::optional<Phase> carried;
        std::optional<Departure> departure;
        if (!(near <= far)) return std::nullopt;
        if (query) {
            carried = query->carried;
            const Query::Start& start = query->start;
            if (start.cell == where.cell && start.geometry == where.geometry && start.instance == where.instance &&
                near == 0) {
                const float along = glm::dot(start.gradient, s.ray.direction);
                departure = Departure{carried == start.from ? -along : along};
            }
        }
        return data.object->first_crossing(where.cell, s.ray, near, far, carried, departure,
                                           query ? query->counters : unused);
    }
};

void intersect(const RTCIntersectFunctionNArguments* arguments) noexcept {
    Asked asked(*arguments);
    const unsigned n = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, n);
    RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, n);
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const Query::Seen& s = asked.seen(rays, n, i);
        const float far = RTCRayN_tfar(rays, n, i) * s.length;
        const std::optional<Crossing> c = asked.crossing(s, RTCRayN_tnear(rays, n, i) * s.length, far);
        if (!c || !(c->t_in <= far)) continue;
        const glm::vec3& along = s.ray.direction;
        const glm::vec3 normal = asked.query ? -along : -asked.data.object->normal(arguments->primID, *c, along).unit;
        RTCRayN_tfar(rays, n, i) = c->t_in / s.length;
        RTCHitN_Ng_x(hits, n, i) = normal.x;
        RTCHitN_Ng_y(hits, n, i) = normal.y;
        RTCHitN_Ng_z(hits, n, i) = normal.z;
        RTCHitN_u(hits, n, i) = static_cast<float>(c->from.index);
        RTCHitN_v(hits, n, i) = static_cast<float>(c->to.index);
        set_place(hits, n, i, arguments->primID, arguments->geomID, *arguments->context);
        if (asked.query) asked.query->crossing = *c;
    }
}

void occluded(const RTCOccludedFunctionNArguments* arguments) noexcept {
    Asked asked(*arguments);
    RTCRayN* rays = arguments->ray;
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const Query::Seen& s = asked.seen(rays, n, i);
        const float far = RTCRayN_tfar(rays, n, i) * s.length;
        const std::optional<Crossing> c = asked.crossing(s, RTCRayN_tnear(rays, n, i) * s.length, far);
        if (c && c->t_in <= far) RTCRayN_tfar(rays, n, i) = -std::numeric_limits<float>::infinity();
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
