#pragma once

#include "api/geometry_data.hpp"
#include "embree_core/embree.hpp"

namespace phasetree::embree::api {

/// The extended context of a query, if the application declared that it has one; else NULL.
inline const PhasetreeRayContext* extended(const GeometryData& data, const Context* context) {
    if (!data.has(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT)) return nullptr;
    const auto* extended = reinterpret_cast<const PhasetreeRayContext*>(context);
    return extended->apiVersion == PHASETREE_API_VERSION ? extended : nullptr;
}

/// The entry of the extended context for the ray with this ID, or NULL.
inline PhasetreeRay* extended_ray_of(const PhasetreeRayContext* context, unsigned id) {
    return context && id < context->rayCount ? context->rays + id : nullptr;
}

/// The phase that the application says the ray is in, for the geometry that a callback was called for. An instance is
/// identified by its innermost ID alone (PhasetreeCarriedPhase).
inline std::optional<Phase> carried(const PhasetreeRay* ray, unsigned geometry, const Context& context) {
    if (!ray) return std::nullopt;
    unsigned level = 0;
#if RTC_MAX_INSTANCE_LEVEL_COUNT > 1
    if (context.instStackSize > 0) level = context.instStackSize - 1;
#endif
    for (unsigned i = 0; i < ray->carriedCount; ++i) {
        const PhasetreeCarriedPhase& entry = ray->carried[i];
        if (entry.geomID != geometry || entry.instID != context.instID[level]) continue;
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
        if (entry.instPrimID != context.instPrimID[level]) continue;
#endif
        if (entry.phase >= PHASETREE_MAX_PHASES) return std::nullopt;
        return Phase{static_cast<std::uint8_t>(entry.phase)};
    }
    return std::nullopt;
}

/// Writes a crossing for the application, where it is known in geometry space. `length` is that of the ray's direction.
inline void write_crossing(PhasetreeHit& hit, const Crossing& crossing, unsigned cell, float length) {
    hit.from = crossing.from.index;
    hit.to = crossing.to.index;
    hit.cell = cell;
    hit.tFrom = crossing.t_from / length;
    hit.tTo = crossing.t_to / length;
    write_point(hit.pointFrom, crossing.p_from);
    write_point(hit.pointTo, crossing.p_to);
}

}  // namespace phasetree::embree::api
