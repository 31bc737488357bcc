// Embree callbacks of an RTCGeometry whose primitives are an object's cells.
#pragma once

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

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

/// The box in which Embree looks for a cell. Every crossing of the cell lies in it: if it did not, Embree might skip
/// the cell because of another cell's crossing behind it, and the closest crossing would depend on the order of visits.
inline Bounds searched_box(const InterfaceCells& cells, std::size_t cell) {
    return cells.bounds(cell).inflated(1.01f * cells.look_back());
}

/// The distance at which a ray enters a box; meaningless if it misses the box.
inline double entry(const Bounds& box, const TracedRay& ray) {
    double result = -std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) continue;
        const double side = ray.direction[axis] > 0 ? box.low[axis] : box.high[axis];
        result = std::max(result, (side - ray.origin[axis]) * ray.inverse[axis]);
    }
    return result;
}

/// Whether a crossing in a cell, which is no farther than the ray's hit so far, replaces that hit. Of equally near
/// crossings, the hit is that of the object with the lower IDs (in the order of ObjectInstance), and within an object,
/// that of the cell that the ray enters first. So the hit does not depend on the order in which Embree visits cells.
/// Embree may skip a cell whose searched_box() the ray enters only at the hit, but such a cell comes last among those
/// of its object.
inline bool replaces_hit(const InterfaceCells& cells, unsigned cell, const ObjectInstance& object,
                         const PreparedRay& prepared, float t, float far, const RTCHit& hit) {
    if (t < far || hit.geomID == RTC_INVALID_GEOMETRY_ID) return true;
    const ObjectInstance other = ObjectInstance::of(hit);
    if (object != other) return object < other;
    if (hit.primID >= cells.size()) return false;
    return std::pair(entry(cells.bounds(cell), prepared.traced), cell) <
           std::pair(entry(cells.bounds(hit.primID), prepared.traced), hit.primID);
}

/// For a single ray whose context is a Query. The hit's normal is not evaluated: Ng is minus the ray's direction.
void intersect_cell_for_query(const InterfaceCells&, const RTCIntersectFunctionNArguments*) noexcept;
void occluded_cell_for_query(const InterfaceCells&, const RTCOccludedFunctionNArguments*) noexcept;

/// For any packet and any context. Calls carried(i) for the phase that lane i carries, if any, and hit(i, crossing,
/// prepared), with the lane's PreparedRay, for each lane whose ray crosses an interface in the cell. If memory runs
/// out, the remaining lanes are skipped, because there is no way to report it.
template <class Arguments, class Carried, class Hit>
void each_crossing(const InterfaceCells& cells, const Arguments& arguments, RTCRayN* rays, Carried&& carried,
                   Hit&& hit) noexcept try {
    TraceCounters unused;
    for (unsigned i = 0; i < arguments.N; ++i) {
        if (arguments.valid[i] != -1) continue;
        const RTCRay ray = rtcGetRayFromRayN(rays, arguments.N, i);
        const PreparedRay prepared(ray);
        if (const auto crossing = search_cell(cells, arguments.primID, prepared, ray, carried(i), std::nullopt, unused))
            hit(i, *crossing, prepared);
    }
} catch (const std::bad_alloc&) {
}

/// Write the packet's hits, and call report(i, crossing, length of the lane's direction) for each.
template <class Carried, class Report>
void intersect_cell_for_packet(const InterfaceCells& cells, const RTCIntersectFunctionNArguments& arguments,
                               Carried&& carried, Report&& report) noexcept {
    const unsigned n = arguments.N, cell = arguments.primID;
    RTCRayN* const rays = RTCRayHitN_RayN(arguments.rayhit, n);
    RTCHitN* const hits = RTCRayHitN_HitN(arguments.rayhit, n);
    each_crossing(
        cells, arguments, rays, carried, [&](unsigned i, const Crossing& crossing, const PreparedRay& prepared) {
            float& far = RTCRayN_tfar(rays, n, i);
            // Rounding must not move a hit outside the ray.
            const float t = std::max(crossing.t_from / prepared.length, std::min(RTCRayN_tnear(rays, n, i), far));
            const ObjectInstance object = ObjectInstance::of(*arguments.context, arguments.geomID);
            if (!replaces_hit(cells, cell, object, prepared, t, far, rtcGetHitFromHitN(hits, n, i))) return;
            far = t;
            const glm::vec3 normal = -cells.normal(cell, crossing, prepared.traced.direction).unit;
            write_hit(hits, n, i, crossing, normal, cell, arguments.geomID, *arguments.context);
            report(i, crossing, prepared.length);
        });
}

/// Mark the rays of the packet that cross an interface in the cell as occluded.
template <class Carried>
void occluded_cell_for_packet(const InterfaceCells& cells, const RTCOccludedFunctionNArguments& arguments,
                              Carried&& carried) noexcept {
    each_crossing(cells, arguments, arguments.ray, carried, [&](unsigned i, const Crossing&, const PreparedRay&) {
        write_occlusion(arguments.ray, arguments.N, i);
    });
}

}  // namespace phasetree::embree
