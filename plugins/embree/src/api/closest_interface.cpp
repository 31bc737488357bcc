// Finds the closest interface to a point, for one geometry, and for Embree's point queries of a whole scene.

#include "embree_core/closest.hpp"

#include "api/geometry_data.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

float checked_tolerance(float tolerance) {
    if (!(tolerance >= 0.001f && tolerance <= 1)) throw invalid("tolerance is {}; it must be 0.001 … 1", tolerance);
    return tolerance;
}

// In the space that `placement` maps to.
PhasetreeClosest closest_in(const Object& object, const Placement& placement, const glm::vec3& point, float radius,
                            float tolerance) {
    const FlushSubnormals flush;
    const Closest c = find_closest(object.scene(), placement.point_within(point), placement.linear, radius,
                                   checked_tolerance(tolerance));
    PhasetreeClosest result{};
    result.found = c.found;
    result.emptyRadius = c.empty_radius;
    result.distance = c.distance;
    write_point(result.point, placement.point(c.point));
    result.from = c.here.index;
    result.to = c.there.index;
    return result;
}

// The map of a point query's innermost instance, or the identity.
Placement instance_of(const RTCPointQueryContext& context) {
    if (context.instStackSize == 0) return {};
    const float* m = context.inst2world[context.instStackSize - 1];
    const float columns[12] = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14]};
    const auto instance = Placement::of(columns);
    if (!instance) throw not_now("the instance's transform has no inverse");
    return *instance;
}

bool query(RTCPointQueryFunctionArguments* args) {
    auto* const result = static_cast<PhasetreePointQuery*>(args->userPtr);
    if (!result || result->apiVersion != PHASETREE_API_VERSION) return false;
    const unsigned depth = args->context->instStackSize;
    const unsigned instance = depth > 0 ? args->context->instID[depth - 1] : RTC_INVALID_GEOMETRY_ID;
    for (unsigned i = 0; i < result->geometryCount; ++i) {
        const PhasetreePointQueryGeometry& listed = result->geometries[i];
        if (listed.geomID != args->geomID || listed.instID != instance) continue;
        const GeometryData& data = api::data_of(listed.geometry);
        const Placement outer = instance_of(*args->context), own = placement_at(data, args->query->time);
        const auto both = Placement::of(outer.linear * own.linear, outer.linear * own.translation + outer.translation);
        if (!both) return false;
        const PhasetreeClosest closest =
            closest_in(*data.object, *both, {args->query->x, args->query->y, args->query->z}, args->query->radius,
                       result->tolerance);
        if (!closest.found || !(closest.distance < args->query->radius)) return false;
        result->closest = closest;
        result->geomID = args->geomID;
        result->instID = instance;
        args->query->radius = closest.distance;
        return true;
    }
    return false;
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeFindClosestInterface(PhasetreeGeometry geometry, const float* point, float time, float radius,
                                             float tolerance, PhasetreeClosest* closest) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const glm::vec3 p = read_point(point);
        require(closest, "closest");
        if (!(radius >= 0)) throw invalid("radius is {}; it must be a distance", radius);
        *closest = closest_in(*data.object, placement_at(data, time), p, radius, tolerance);
    });
}

bool phasetreePointQueryFunction(RTCPointQueryFunctionArguments* args) {
    bool is_nearer = false;
    const PhasetreeError error = guarded_call(__func__, [&] { is_nearer = query(args); });
    return error == PHASETREE_ERROR_NONE && is_nearer;
}
