/// What is asked of a geometry beside rays: the meaning of a hit, points.

#include <algorithm>
#include <cmath>
#include <limits>

#include "api/geometry_data.hpp"
#include "lanes.hpp"
#include "object/closest.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

void write(float* out, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = v[i];
}

glm::vec3 read_point(const float* p) {
    require(p, "point");
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(p[i])) throw invalid("point has an entry that is no finite number");
    return {p[0], p[1], p[2]};
}

unsigned checked_phase(float coordinate, const char* name) {
    if (!(coordinate >= 0) || coordinate >= PHASETREE_MAX_PHASES || coordinate != std::floor(coordinate))
        throw not_now(
            fmt::format("rayhit->hit.{} is {}, which is no phase: the hit is another geometry's", name, coordinate));
    return static_cast<unsigned>(coordinate);
}

/// A hit's ray in the tree's own space, and what was on the way there.
struct HitRay {
    LaneRay ray;
    Placement placement;
    float blur;  ///< in units of the direction given, what a coordinate's rounding can be
};

constexpr float ulps = 4e-7f;

/// Throws ApiError where there is no hit, or no way.
HitRay ray_of_hit(const GeometryData& data, const RTCRayHit& rayhit, const float* object_to_world) {
    if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) throw not_now("the ray hit nothing");
    const bool is_instanced = rayhit.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    if (is_instanced && !object_to_world)
        throw invalid("objectToWorld is NULL, but the hit is in the instance {}", rayhit.hit.instID[0]);
    // From the world into the geometry's space, and from there into the object's.
    glm::vec3 origin{rayhit.ray.org_x, rayhit.ray.org_y, rayhit.ray.org_z};
    glm::vec3 direction{rayhit.ray.dir_x, rayhit.ray.dir_y, rayhit.ray.dir_z};
    const float blur = ulps * (glm::length(origin) / glm::length(direction) + rayhit.ray.tfar);
    if (is_instanced) {
        const auto instance = Placement::of(object_to_world);
        if (!instance) throw invalid("objectToWorld has no inverse");
        origin = instance->point_within(origin);
        direction = instance->direction_within(direction);
    }
    const Placement placement = placement_at(data, rayhit.ray.time);
    if (!data.motion.none()) {
        origin = placement.point_within(origin);
        direction = placement.direction_within(direction);
    }
    const auto ray = LaneRay::of(origin, direction, rayhit.ray.tnear, rayhit.ray.tfar);
    if (!ray || !std::isfinite(ray->far)) throw not_now("rayhit->ray is no ray with a hit");
    return {*ray, placement, blur};
}

/// The bracket again: what changes from one phase to the other within a few resolutions of t. The cell that the hit
/// names has found it and knows it still; if not, because the hit comes from elsewhere, all cells are asked.
std::optional<Crossing> bracket(const Object& object, unsigned cell, const LaneRay& ray, Phase from, Phase to) {
    const float resolution = object.cells().resolution();
    const float t = ray.far;
    // Distances along the ray are known to some ulps of themselves.
    const float slack = 4 * resolution + 4e-7f * t;
    const float start = std::max(t - slack, ray.near), end = t + 2 * slack;
    TraceCounters unused;
    // As the walk below asks it, where a direction's length may be rounded.
    const float length = glm::length(ray.direction);
    const auto own = object.cells().first_crossing(cell, TracedRay(ray.origin, ray.direction), start * length,
                                                   end * length, from, std::nullopt, unused);
    if (own && own->to == to) return own;
    Walk walk(object, {ray.origin, ray.direction, start, end}, from);
    for (int i = 0; i < 4; ++i) {
        const auto found = walk.next();
        if (!found) break;
        if (found->crossing.to == to) return found->crossing;
    }
    return std::nullopt;
}

/// Moves a bracket's far end on, by less than two resolutions, to where the phase is the same within `blur`: a ray that
/// is given to Embree anew, and rounded on its way to us, then still starts in it.
void move_on(Crossing& c, const InterfaceCells& cells, unsigned cell, const glm::vec3& direction, float blur) {
    BatchOfFloats t;
    for (std::size_t i = 0; i < batch_size; ++i) t[i] = cells.resolution() * (2.f / batch_size) * static_cast<float>(i);
    Samples s;
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    // All samples are between these two.
    const Bounds box = cells.bounds(cell);
    if (box.contains(c.p_out) && box.contains(c.p_out + t[batch_size - 1] * direction))
        cells.sample_ray(cell, c.p_out, direction, t, s, workspace);
    else
        cells.whole().sample_ray(c.p_out, direction, t, s, workspace);
    std::size_t best = 0;
    for (std::size_t i = 0; i < batch_size && s.distance[best] < blur; ++i) {
        if (s.label[i] != static_cast<float>(c.to.index)) break;
        if (s.distance[i] > s.distance[best]) best = i;
    }
    c.t_out += t[best];
    c.p_out += t[best] * direction;
}

}  // namespace

Placement placement_at(const GeometryData& data, float time) {
    const auto placement = data.motion.at(time);
    if (!placement) throw not_now(fmt::format("at time {} the motion's transform has no inverse", time));
    return *placement;
}

float radius_without_interface(const GeometryData& data, const glm::vec3& p, float sampled,
                               const Placement& placement) {
    const InterfaceCells& cells = data.object->cells();
    const float radius =
        cells.bounds().contains(p) ? sampled : glm::distance(p, glm::clamp(p, cells.bounds().low, cells.bounds().high));
    const float safe = std::max(0.0f, radius - cells.resolution());
    return data.motion.none() ? safe
                              : static_cast<float>(static_cast<double>(safe) / largest_stretch(placement.inverse));
}

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeDecodeHit(PhasetreeGeometry geometry, const RTCRayHit* rayhit, const float* object_to_world,
                                  PhasetreeHit* hit) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(rayhit, "rayhit");
        require(hit, "hit");
        if (rayhit->hit.geomID == RTC_INVALID_GEOMETRY_ID) throw not_now("the ray hit nothing");
        const Object& object = *data.object;
        if (rayhit->hit.primID >= object.cells().size())
            throw not_now(
                fmt::format("rayhit->hit.primID is {}, but the geometry has {} cells: the hit is another "
                            "geometry's",
                            rayhit->hit.primID, object.cells().size()));
        PhasetreeHit found{};
        found.phaseLeft = checked_phase(rayhit->hit.u, "u");
        found.phaseEntered = checked_phase(rayhit->hit.v, "v");
        found.cell = rayhit->hit.primID;
        const auto [ray, placement, blur] = ray_of_hit(data, *rayhit, object_to_world);
        const FlushSubnormals flush;
        auto c = bracket(object, found.cell, ray, Phase{static_cast<std::uint8_t>(found.phaseLeft)},
                         Phase{static_cast<std::uint8_t>(found.phaseEntered)});
        glm::vec3 in = ray.origin + ray.far * ray.direction, out = in;
        found.tIn = found.tOut = rayhit->ray.tfar;
        if (c) {
            move_on(*c, object.cells(), found.cell, ray.direction,
                    std::max(blur * ray.length, ulps * (glm::length(ray.origin) + ray.far)));
            in = c->p_in;
            out = c->p_out;
            found.tIn = c->t_in / ray.length;
            found.tOut = c->t_out / ray.length;
        }
        write(found.pointIn, data.motion.none() ? in : placement.point(in));
        write(found.pointOut, data.motion.none() ? out : placement.point(out));
        *hit = found;
    });
}

PhasetreeError phasetreeGetHitTreePoint(PhasetreeGeometry geometry, const RTCRayHit* rayhit,
                                        const float* object_to_world, float* tree_point) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(rayhit, "rayhit");
        require(tree_point, "treePoint");
        const LaneRay ray = ray_of_hit(data, *rayhit, object_to_world).ray;
        write(tree_point, glm::vec3(glm::dvec3(ray.origin) + static_cast<double>(ray.far) * glm::dvec3(ray.direction)));
    });
}

PhasetreeError phasetreeGetTreePoint(PhasetreeGeometry geometry, const float* point, float time, float* tree_point) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const glm::vec3 there = read_point(point);
        require(tree_point, "treePoint");
        const Placement placement = placement_at(data, time);
        write(tree_point, data.motion.none() ? there : placement.point_within(there));
    });
}

PhasetreeError phasetreeGetPhase(PhasetreeGeometry geometry, const float* point, float time, unsigned int* phase,
                                 float* empty_radius) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const glm::vec3 there = read_point(point);
        require(phase, "phase");
        const Placement placement = placement_at(data, time);
        const glm::vec3 p = data.motion.none() ? there : placement.point_within(there);
        const InterfaceCells& cells = data.object->cells();
        const FlushSubnormals flush;
        Evaluator::Workspace& workspace = Evaluator::thread_workspace();
        if (empty_radius) {
            BatchOfFloats x, y, z;
            x.lane.fill(p.x);
            y.lane.fill(p.y);
            z.lane.fill(p.z);
            Samples s;
            cells.whole().sample(x, y, z, s, workspace);
            *empty_radius = radius_without_interface(data, p, s.distance[0], placement);
        }
        *phase = cells.label(p, workspace).index;
    });
}

PhasetreeError phasetreeGetDistances(PhasetreeGeometry geometry, const float* point, float time, float* distances) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const glm::vec3 there = read_point(point);
        require(distances, "distances");
        const Placement placement = placement_at(data, time);
        const FlushSubnormals flush;
        const Phases<float> phi = data.object->cells().whole().distances(
            data.motion.none() ? there : placement.point_within(there), Evaluator::thread_workspace());
        for (int i = 0; i < PHASETREE_MAX_PHASES; ++i)
            distances[i] = phi.has(i) ? phi[i] : std::numeric_limits<float>::infinity();
    });
}

namespace phasetree::embree::api {
namespace {

float checked_tolerance(float tolerance) {
    if (!(tolerance >= 0.001f && tolerance <= 1)) throw invalid("tolerance is {}; it must be 0.001 … 1", tolerance);
    return tolerance;
}

/// In the space that `placement` maps to.
PhasetreeClosest closest_in(const Object& object, const Placement& placement, const glm::vec3& point, float radius,
                            float tolerance) {
    const FlushSubnormals flush;
    const Closest c =
        find_closest(object, placement.point_within(point), placement.linear, radius, checked_tolerance(tolerance));
    PhasetreeClosest result{};
    result.found = c.found;
    result.emptyRadius = c.empty_radius;
    result.distance = c.distance;
    write(result.point, placement.point(c.point));
    result.here = c.here.index;
    result.there = c.there.index;
    return result;
}

/// The innermost instance's map of a point query, or the identity.
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
