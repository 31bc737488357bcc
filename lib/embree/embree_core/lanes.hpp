// Packets of rays, lane by lane: access for callbacks.
#pragma once

#include "embree_core/rays.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::embree {

/// The ray of a lane; nullopt if it cannot hit anything.
inline std::optional<UnitRay> unit_ray(RTCRayN* rays, unsigned n, unsigned i) {
    return UnitRay::of({RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
                       {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
                       RTCRayN_tnear(rays, n, i), RTCRayN_tfar(rays, n, i));
}

/// Write a change of phase as a lane's hit: the phases in u and v, the cell in primID, and the geometry and instance.
/// `normal` is on the side the ray comes from.
inline void write_hit(RTCHitN* hits, unsigned n, unsigned i, const Crossing& crossing, const glm::vec3& normal,
                      unsigned cell, unsigned geometry, const Context& context) {
    RTCHitN_Ng_x(hits, n, i) = normal.x;
    RTCHitN_Ng_y(hits, n, i) = normal.y;
    RTCHitN_Ng_z(hits, n, i) = normal.z;
    RTCHitN_u(hits, n, i) = static_cast<float>(crossing.from.index);
    RTCHitN_v(hits, n, i) = static_cast<float>(crossing.to.index);
    RTCHitN_primID(hits, n, i) = cell;
    RTCHitN_geomID(hits, n, i) = geometry;
    for (unsigned level = 0; level < RTC_MAX_INSTANCE_LEVEL_COUNT; ++level) {
        RTCHitN_instID(hits, n, i, level) = context.instID[level];
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
        RTCHitN_instPrimID(hits, n, i, level) = context.instPrimID[level];
#endif
    }
}

/// Mark a lane's occlusion ray as occluded, as Embree requires.
inline void write_occlusion(RTCRayN* rays, unsigned n, unsigned i) {
    RTCRayN_tfar(rays, n, i) = -std::numeric_limits<float>::infinity();
}

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

}  // namespace phasetree::embree
