#pragma once

/// One lane of a packet of rays, and Embree's two ways of asking a filter function.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/embree_version.hpp"

namespace phasetree::embree {

/// A ray as tracing wants it: in distances, not in units of its direction.
struct LaneRay {
    glm::vec3 origin, direction;
    float near, far;
    float length;  ///< of the direction as it was; now it is a unit vector

    /// Of a direction, if the ray can hit anything; else 0.
    static float length_of(const glm::vec3& origin, const glm::vec3& direction) {
        const float length = glm::length(direction);
        const bool is_finite = std::isfinite(origin.x) && std::isfinite(origin.y) && std::isfinite(origin.z);
        return is_finite && std::isfinite(length) ? length : 0.f;
    }
    /// Dividing a unit vector by its rounded length would move a carried start's samples off its bracket for nothing.
    static glm::vec3 unit(const glm::vec3& direction, float length) {
        return std::abs(length - 1) < 1e-6f ? direction : direction / length;
    }

    /// Nothing for a ray that can hit nothing: with numbers that are not finite, without a direction, or reversed.
    static std::optional<LaneRay> of(RTCRayN* rays, unsigned n, unsigned i) {
        return of({RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
                  {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
                  RTCRayN_tnear(rays, n, i), RTCRayN_tfar(rays, n, i));
    }
    static std::optional<LaneRay> of(const glm::vec3& origin, const glm::vec3& d, float t_near, float t_far) {
        LaneRay r;
        r.origin = origin;
        r.length = length_of(origin, d);
        if (r.length == 0) return std::nullopt;
        r.direction = unit(d, r.length);
        r.near = t_near * r.length;
        r.far = t_far * r.length;
        if (!(r.near <= r.far)) return std::nullopt;
        return r;
    }
};

inline void call_filters(const RTCIntersectFunctionNArguments* arguments, const RTCFilterFunctionNArguments* hit) {
#if PHASETREE_EMBREE_MAJOR == 4
    rtcInvokeIntersectFilterFromGeometry(arguments, hit);
#else
    rtcFilterIntersection(arguments, hit);
#endif
}
inline void call_filters(const RTCOccludedFunctionNArguments* arguments, const RTCFilterFunctionNArguments* hit) {
#if PHASETREE_EMBREE_MAJOR == 4
    rtcInvokeOccludedFilterFromGeometry(arguments, hit);
#else
    rtcFilterOcclusion(arguments, hit);
#endif
}

/// Writes where in the scene a hit is; the caller says what it is.
inline void set_place(RTCHitN* hits, unsigned n, unsigned i, unsigned prim, unsigned geometry, const Context& context) {
    RTCHitN_primID(hits, n, i) = prim;
    RTCHitN_geomID(hits, n, i) = geometry;
    for (unsigned level = 0; level < RTC_MAX_INSTANCE_LEVEL_COUNT; ++level) {
        RTCHitN_instID(hits, n, i, level) = context.instID[level];
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
        RTCHitN_instPrimID(hits, n, i, level) = context.instPrimID[level];
#endif
    }
}

}  // namespace phasetree::embree
