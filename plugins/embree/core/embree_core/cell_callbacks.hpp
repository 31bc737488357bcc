#pragma once

/// Embree callbacks of an RTCGeometry whose primitives are an object's cells.

#include <algorithm>
#include <new>

#include "embree_core/lanes.hpp"
#include "embree_core/query.hpp"

namespace phasetree::embree {

/// Copy a box into Embree's bounds.
inline void write_bounds(RTCBounds& out, const Bounds& box) {
    out.lower_x = box.low.x;
    out.lower_y = box.low.y;
    out.lower_z = box.low.z;
    out.upper_x = box.high.x;
    out.upper_y = box.high.y;
    out.upper_z = box.high.z;
}

/// For a single ray whose context is a Query. The hit's normal is not evaluated: Ng is minus the ray's direction.
void intersect_cell_for_query(const InterfaceCells&, const RTCIntersectFunctionNArguments*) noexcept;
void occluded_cell_for_query(const InterfaceCells&, const RTCOccludedFunctionNArguments*) noexcept;

/// For any packet and any context. Calls carried(i) for the phase that lane i carries, if any, and hit(i, crossing,
/// seen), with the lane's SeenRay, for each lane whose ray crosses an interface in the cell. If memory runs out, the
/// remaining lanes are skipped, because there is no way to report it.
template <class Arguments, class Carried, class Hit>
void each_crossing(const InterfaceCells& cells, const Arguments& arguments, RTCRayN* rays, Carried&& carried,
                   Hit&& hit) noexcept try {
    TraceCounters unused;
    for (unsigned i = 0; i < arguments.N; ++i) {
        if (arguments.valid[i] != -1) continue;
        const RTCRay ray = rtcGetRayFromRayN(rays, arguments.N, i);
        const SeenRay seen(ray);
        if (const auto crossing = search_cell(cells, arguments.primID, seen, ray, carried(i), std::nullopt, unused))
            hit(i, *crossing, seen);
    }
} catch (const std::bad_alloc&) {
}

/// Write the packet's hits, and call report(i, crossing, length of the lane's direction) for each.
template <class Carried, class Report>
void intersect_cell_for_packet(const InterfaceCells& cells, const RTCIntersectFunctionNArguments& arguments,
                               Carried&& carried, Report&& report) noexcept {
    const unsigned n = arguments.N, cell = arguments.primID;
    RTCRayN* const rays = RTCRayHitN_RayN(arguments.rayhit, n);
    each_crossing(cells, arguments, rays, carried, [&](unsigned i, const Crossing& crossing, const SeenRay& seen) {
        const glm::vec3 normal = -cells.normal(cell, crossing, seen.traced.direction).unit;
        float& far = RTCRayN_tfar(rays, n, i);
        // Rounding must not move a hit outside the ray.
        far = std::clamp(crossing.t_in / seen.length, std::min(RTCRayN_tnear(rays, n, i), far), far);
        write_hit(RTCRayHitN_HitN(arguments.rayhit, n), n, i, crossing, normal, cell, arguments.geomID,
                  *arguments.context);
        report(i, crossing, seen.length);
    });
}

/// Mark the rays of the packet that cross an interface in the cell as occluded.
template <class Carried>
void occluded_cell_for_packet(const InterfaceCells& cells, const RTCOccludedFunctionNArguments& arguments,
                              Carried&& carried) noexcept {
    each_crossing(cells, arguments, arguments.ray, carried,
                  [&](unsigned i, const Crossing&, const SeenRay&) { write_occlusion(arguments.ray, arguments.N, i); });
}

}  // namespace phasetree::embree
