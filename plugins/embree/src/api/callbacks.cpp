// Callbacks that Embree calls while it builds and traces.

#include "api/packet.hpp"
#include "embree_core/cell_callbacks.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

// For a geometry whose primitives are the cells. Carried phases are read from the application's context, and crossings
// are written to it.
void trace_cell(const GeometryData& data, const RTCIntersectFunctionNArguments& arguments) {
    const PhasetreeRayContext* const context = extended(data, arguments.context);
    RTCRayN* const rays = RTCRayHitN_RayN(arguments.rayhit, arguments.N);
    const auto ray = [&](unsigned i) { return extended_ray_of(context, RTCRayN_id(rays, arguments.N, i)); };
    intersect_cell_for_packet(
        data.object->cells(), arguments,
        [&](unsigned i) { return carried(ray(i), arguments.geomID, *arguments.context); },
        [&](unsigned i, const Crossing& crossing, float length) {
            if (PhasetreeRay* const extended_ray = ray(i))
                write_crossing(extended_ray->hit, crossing, arguments.primID, length);
        });
}

void trace_cell(const GeometryData& data, const RTCOccludedFunctionNArguments& arguments) {
    const PhasetreeRayContext* const context = extended(data, arguments.context);
    occluded_cell_for_packet(data.object->cells(), arguments, [&](unsigned i) {
        return carried(extended_ray_of(context, RTCRayN_id(arguments.ray, arguments.N, i)), arguments.geomID,
                       *arguments.context);
    });
}

// The maximum number of rays per callback (rtcIntersect16).
constexpr unsigned largest_packet = 16;

template <class Arguments>
void trace(PhasetreeGeometry geometry, const Arguments* arguments) noexcept {
    const GeometryData* data = find(geometry);
    if (!data || !data->object || arguments->N > largest_packet) return;
    const FlushSubnormals flush;
    if (!data->has_cell_primitives())
        Packet<Arguments>(*data, arguments).trace();
    else if (arguments->primID < data->object->cells().size())
        trace_cell(*data, *arguments);
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

void phasetreeGetPrimitiveBounds(PhasetreeGeometry geometry, const RTCBoundsFunctionArguments* args) {
    const GeometryData* data = find(geometry);
    Bounds box;
    if (data && data->object) {
        const InterfaceCells& cells = data->object->cells();
        if (!data->has_cell_primitives())
            box = data->motion.image(cells.bounds(), args->timeStep);
        else if (args->primID < cells.size())
            box = searched_box(cells, args->primID);
    }
    write_bounds(*args->bounds_o, box);
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
