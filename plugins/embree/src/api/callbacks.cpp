/// What Embree calls while it builds and traces.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>

#include "api/geometry_data.hpp"
#include "lanes.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

/// A lane's ray within the object, and the way back.
struct Ray {
    ObjectRay ray;
    float length;  ///< of its direction before: distances divided by it are the lane's

    static std::optional<Ray> of(RTCRayN* rays, unsigned n, unsigned i, const std::optional<Placement>& placement) {
        auto lane = LaneRay::of(rays, n, i);
        if (lane && placement)
            lane = LaneRay::of(placement->point_within(lane->origin),
                               placement->direction_within(lane->direction * lane->length), RTCRayN_tnear(rays, n, i),
                               RTCRayN_tfar(rays, n, i));
        if (!lane) return std::nullopt;
        return Ray{{lane->origin, lane->direction, std::max(lane->near, 0.0f), lane->far}, lane->length};
    }
};

/// The extended context of a query, if the application says that it has one.
const PhasetreeRayContext* extended(const GeometryData& data, const Context* context) {
    if (!data.has(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT)) return nullptr;
    const auto* extended = reinterpret_cast<const PhasetreeRayContext*>(context);
    return extended->apiVersion == PHASETREE_API_VERSION ? extended : nullptr;
}

PhasetreeRay* ray_of(const PhasetreeRayContext* context, unsigned id) {
    return context && id < context->rayCount ? context->rays + id : nullptr;
}

std::optional<Phase> carried(const PhasetreeRay* ray, unsigned geometry, const Context& context) {
    if (!ray) return std::nullopt;
    unsigned level = 0;
#if RTC_MAX_INSTANCE_LEVEL_COUNT > 1
    if (context.instStackSize > 0) level = context.instStackSize - 1;
#endif
    for (unsigned i = 0; i < ray->mediumCount; ++i) {
        const PhasetreeMedium& medium = ray->media[i];
        if (medium.geomID != geometry || medium.instID != context.instID[level]) continue;
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
        if (medium.instPrimID != context.instPrimID[level]) continue;
#endif
        if (medium.phase >= PHASETREE_MAX_PHASES) return std::nullopt;
        return Phase{static_cast<std::uint8_t>(medium.phase)};
    }
    return std::nullopt;
}

void write(float* out, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = v[i];
}

/// One packet that has come to a geometry, for intersection or occlusion.
template <class Arguments>
class Packet {
    static constexpr bool occlusion = std::is_same_v<Arguments, RTCOccludedFunctionNArguments>;

  public:
    Packet(const GeometryData& data, const Arguments* arguments)
        : data_(data), arguments_(arguments), n_(arguments->N), context_(extended(data, arguments->context)) {
        if constexpr (occlusion) {
            rays_ = arguments->ray;
        } else {
            rays_ = RTCRayHitN_RayN(arguments->rayhit, n_);
            hits_ = RTCRayHitN_HitN(arguments->rayhit, n_);
        }
    }

    /// A ray for which there is no memory hits nothing: nobody can be told, and Embree lets no exception through.
    void trace() {
        for (unsigned i = 0; i < n_; ++i) {
            if (arguments_->valid[i] != -1) continue;
            try {
                trace(i);
            } catch (const std::bad_alloc&) {
            }
        }
    }

  private:
    void trace(unsigned i) {
        std::optional<Placement> placement;
        if (!data_.motion.none()) {
            placement = data_.motion.at(RTCRayN_time(rays_, n_, i));
            if (!placement) return;
        }
        const auto ray = Ray::of(rays_, n_, i, placement);
        if (!ray) return;
        PhasetreeRay* const extended_ray = ray_of(context_, RTCRayN_id(rays_, n_, i));
        const auto phase = carried(extended_ray, arguments_->geomID, *arguments_->context);
        const bool filters = !data_.has(PHASETREE_GEOMETRY_FLAG_NO_FILTERS);
        if (occlusion && !filters && shows_all()) {
            if (data_.object->any_crossing(ray->ray, phase)) occlude(i);
            return;
        }
        Walk walk(*data_.object, ray->ray, phase);
        while (const auto found = walk.next()) {
            if (!data_.shows(found->crossing)) continue;
            if (offer(i, *ray, *found, placement, filters, extended_ray)) return;
        }
    }

    bool shows_all() const {
        const std::uint64_t materials = ~std::uint64_t{1};
        return (data_.shown.bits & materials) == materials;
    }

    void occlude(unsigned i) { RTCRayN_tfar(rays_, n_, i) = -std::numeric_limits<float>::infinity(); }

    /// Whether the crossing is accepted as the lane's hit, which is then written.
    bool offer(unsigned i, const Ray& ray, const Object::Found& found, const std::optional<Placement>& placement,
               bool filters, PhasetreeRay* extended_ray) {
        const Crossing& c = found.crossing;
        float& far = RTCRayN_tfar(rays_, n_, i);
        const float before = far;
        // Rounding shall not put a hit outside of the ray.
        const float t = std::clamp(c.t_in / ray.length, std::min(RTCRayN_tnear(rays_, n_, i), before), before);
        RTCHitN* const candidate = reinterpret_cast<RTCHitN*>(candidates_.data());
        if (occlusion && !filters) {
            occlude(i);
            return true;
        }
        glm::vec3 normal = -data_.object->cells().normal(found.cell, c, ray.ray.direction).unit;
        if (placement) normal = placement->normal(normal);
        RTCHitN_Ng_x(candidate, n_, i) = normal.x;
        RTCHitN_Ng_y(candidate, n_, i) = normal.y;
        RTCHitN_Ng_z(candidate, n_, i) = normal.z;
        RTCHitN_u(candidate, n_, i) = static_cast<float>(c.from.index);
        RTCHitN_v(candidate, n_, i) = static_cast<float>(c.to.index);
        set_place(candidate, n_, i, found.cell, arguments_->geomID, *arguments_->context);
        far = t;
        if (filters && !is_accepted(i, candidate)) {
            far = before;
            return false;
        }
        if constexpr (occlusion) {
            occlude(i);
        } else {
            RTCHit hit = rtcGetHitFromHitN(candidate, n_, i);
            rtcCopyHitToHitN(hits_, &hit, n_, i);
            if (extended_ray) report(extended_ray->hit, ray, found, placement);
        }
        return true;
    }

    bool is_accepted(unsigned i, RTCHitN* candidate) {
        std::array<int, 16> valid{};
        valid[i] = -1;
        RTCFilterFunctionNArguments call{};
        call.valid = valid.data();
        call.geometryUserPtr = data_.user_pointer;
        call.context = arguments_->context;
        if constexpr (occlusion)
            call.ray = rays_;
        else
            call.ray = reinterpret_cast<RTCRayN*>(arguments_->rayhit);
        call.hit = candidate;
        call.N = n_;
        call_filters(arguments_, &call);
        if (valid[i] == -1 && context_ && context_->filter) context_->filter(&call);
        return valid[i] == -1;
    }

    static void report(PhasetreeHit& hit, const Ray& ray, const Object::Found& found,
                       const std::optional<Placement>& placement) {
        const Crossing& c = found.crossing;
        hit.phaseLeft = c.from.index;
        hit.phaseEntered = c.to.index;
        hit.cell = found.cell;
        hit.tIn = c.t_in / ray.length;
        hit.tOut = c.t_out / ray.length;
        write(hit.pointIn, placement ? placement->point(c.p_in) : c.p_in);
        write(hit.pointOut, placement ? placement->point(c.p_out) : c.p_out);
    }

    const GeometryData& data_;
    const Arguments* arguments_;
    unsigned n_;
    const PhasetreeRayContext* context_;
    RTCRayN* rays_ = nullptr;
    RTCHitN* hits_ = nullptr;
    alignas(RTCHit16) std::array<std::byte, sizeof(RTCHit16)> candidates_;
};

template <class Arguments>
void trace(PhasetreeGeometry geometry, const Arguments* arguments) noexcept {
    const GeometryData* data = find(geometry);
    if (!data || !data->object || arguments->N > 16) return;
    const FlushSubnormals flush;
    Packet<Arguments>(*data, arguments).trace();
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree::api;

void phasetreeGetPrimitiveBounds(PhasetreeGeometry geometry, const RTCBoundsFunctionArguments* args) {
    const GeometryData* data = find(geometry);
    const Bounds b =
        data && data->object ? data->motion.image(data->object->cells().bounds(), args->timeStep) : Bounds{};
    *args->bounds_o = RTCBounds{b.low.x, b.low.y, b.low.z, 0, b.high.x, b.high.y, b.high.z, 0};
}

void phasetreeIntersectPrimitive(PhasetreeGeometry geometry, const RTCIntersectFunctionNArguments* args) {
    trace(geometry, args);
}

void phasetreeOccludedPrimitive(PhasetreeGeometry geometry, const RTCOccludedFunctionNArguments* args) {
    trace(geometry, args);
}

void phasetreeBoundsFunction(const RTCBoundsFunctionArguments* args) {
    phasetreeGetPrimitiveBounds(static_cast<PhasetreeGeometry>(args->geometryUserPtr), args);
}

void phasetreeIntersectFunction(const RTCIntersectFunctionNArguments* args) {
    phasetreeIntersectPrimitive(static_cast<PhasetreeGeometry>(args->geometryUserPtr), args);
}

void phasetreeOccludedFunction(const RTCOccludedFunctionNArguments* args) {
    phasetreeOccludedPrimitive(static_cast<PhasetreeGeometry>(args->geometryUserPtr), args);
}
