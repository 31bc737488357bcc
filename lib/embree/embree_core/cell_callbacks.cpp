#include "embree_core/cell_callbacks.hpp"

#include <memory>
#include <type_traits>

namespace phasetree::embree {

namespace {

Query& query_of(Context* context) {
    return *reinterpret_cast<Query*>(context);
}

// Records another ray in the existing storage. Most rays hit only a cell or two, so the cost of this matters.
void prepare_ray(Query& query, const RTCRay& ray) {
    static_assert(std::is_trivially_destructible_v<PreparedRay>);
    std::construct_at(&query.prepared, ray);
}

// Returns the first crossing in the cell. If memory runs out, returns nullopt and sets Query::is_out_of_memory.
template <class Arguments>
std::optional<Crossing> search(const InterfaceCells& cells, const Arguments& arguments, Query& query,
                               const RTCRay& ray) noexcept {
    try {
        if (!query.prepared.is(ray)) prepare_ray(query, ray);
        const StartHint& start = query.start;
        std::optional<Phase> carried = query.default_phase;
        std::optional<LeavingHint> leaving_hint;
        const bool may_start_here = start.cell == arguments.primID && ray.tnear == 0;
        // Most rays carry one phase for all objects and do not start in this cell. Then it does not matter which object
        // the cell belongs to, and nothing needs to be compared.
        if (may_start_here || !query.carried.empty()) {
            const ObjectInstance object = ObjectInstance::of(*arguments.context, arguments.geomID);
            carried = RayPhases::find(query.carried, query.default_phase, object);
            if (may_start_here && start.object == object) {
                // The gradient is that of the signed distance of `from`, which is negative in `from` and rises into the
                // other phase. The hint is the derivative, along the ray, of the unsigned distance from the interface.
                // In `from`, that distance is minus the signed distance, so the derivative has the other sign.
                const float along = glm::dot(start.gradient, query.prepared.traced.direction);
                leaving_hint = LeavingHint{carried == start.from ? -along : along};
            }
        }
        return search_cell(cells, arguments.primID, query.prepared, ray, carried, leaving_hint, query.counters);
    } catch (const std::bad_alloc&) {
        query.is_out_of_memory = true;
        return std::nullopt;
    }
}

}  // namespace

void intersect_cell_for_query(const InterfaceCells& cells, const RTCIntersectFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1) return;
    Query& query = query_of(arguments->context);
    if (query.skips_cells) return;
    auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const auto crossing = search(cells, *arguments, query, ray);
    if (!crossing) return;
    const float t = crossing->t_from / query.prepared.length;
    const ObjectInstance object = ObjectInstance::of(*arguments->context, arguments->geomID);
    if (!replaces_hit(cells, arguments->primID, object, query.prepared, t, ray.tfar, hit)) return;
    ray.tfar = t;
    write_hit(RTCRayHitN_HitN(arguments->rayhit, 1), 1, 0, *crossing, -query.prepared.traced.direction,
              arguments->primID, arguments->geomID, *arguments->context);
    query.crossing = *crossing;
}

void occluded_cell_for_query(const InterfaceCells& cells, const RTCOccludedFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1) return;
    const RTCRay& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    Query& query = query_of(arguments->context);
    if (query.skips_cells) return;
    if (search(cells, *arguments, query, ray)) write_occlusion(arguments->ray, 1, 0);
}

}  // namespace phasetree::embree
