// Decodes a hit: where exactly the phases meet, and where that is in the tree.

#include <algorithm>
#include <cmath>

#include "api/geometry_data.hpp"
#include "embree_core/walk.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

unsigned checked_phase(float coordinate, const char* name) {
    if (!(coordinate >= 0) || coordinate >= PHASETREE_MAX_PHASES || coordinate != std::floor(coordinate))
        throw not_now(fmt::format("rayhit->hit.{} is {}, which is not a phase; the hit belongs to another geometry",
                                  name, coordinate));
    return static_cast<unsigned>(coordinate);
}

// The ray of a hit in the tree's own space, up to the hit.
struct HitRay {
    UnitRay ray;
    Placement placement;  // of the tree in geometry space, at the ray's time
    float blur;           // possible displacement of the hit by rounding, in units of the original direction's length
};

// A few rounding errors, relative to a number.
constexpr float ulps = 4e-7f;

// Throws ApiError if there is no hit, or no way to transform its ray.
HitRay ray_of_hit(const GeometryData& data, const RTCRayHit& rayhit, const float* object_to_world) {
    if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) throw not_now("the ray hit nothing");
    const bool is_instanced = rayhit.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    if (is_instanced && !object_to_world)
        throw invalid("objectToWorld is NULL, but the hit is in the instance {}", rayhit.hit.instID[0]);
    // From the world to geometry space, and from there to object space.
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
    const auto ray = UnitRay::of(origin, direction, rayhit.ray.tnear, rayhit.ray.tfar);
    if (!ray || !std::isfinite(ray->far)) throw not_now("rayhit->ray is not a valid ray with a hit");
    return {*ray, placement, blur};
}

// Finds the bracket again: the change from one phase to the other within a few resolutions of t. The cell that the hit
// names found it and can find it again. Otherwise the hit comes from elsewhere, and all cells are searched.
std::optional<Crossing> bracket(const Object& object, unsigned cell, const UnitRay& ray, Phase from, Phase to) {
    const float resolution = object.cells().resolution();
    const float t = ray.far;
    // Distances along the ray are accurate to a few rounding errors.
    const float slack = 4 * resolution + ulps * t;
    const float start = std::max(t - slack, ray.near), end = t + 2 * slack;
    TraceCounters unused;
    // The walk below multiplies distances by the direction's rounded length. Divide by the same length here, so that it
    // searches the same span.
    const float length = glm::length(ray.direction);
    const auto own = object.cells().first_crossing(cell, TracedRay(ray.origin, ray.direction), start * length,
                                                   end * length, from, std::nullopt, unused);
    if (own && own->to == to) return own;
    Walk walk(object.scene(), {ray.origin, ray.direction, start, end}, from);
    for (int i = 0; i < 4; ++i) {
        const auto found = walk.next();
        if (!found) break;
        if (found->crossing.to == to) return found->crossing;
    }
    return std::nullopt;
}

// Advances a bracket's far end, by less than two resolutions, to where the phase is constant within `blur`. A ray from
// there, passed to Embree again and rounded on its way back, then still starts in that phase.
void move_on(Crossing& c, const InterfaceCells& cells, unsigned cell, const glm::vec3& direction, float blur) {
    BatchOfFloats t;
    for (std::size_t i = 0; i < batch_size; ++i) t[i] = cells.resolution() * (2.f / batch_size) * static_cast<float>(i);
    Samples s;
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    // All samples are between these two.
    const Bounds box = cells.bounds(cell);
    if (box.contains(c.p_to) && box.contains(c.p_to + t[batch_size - 1] * direction))
        cells.sample_ray(cell, c.p_to, direction, t, s, workspace);
    else
        cells.whole().sample_ray(c.p_to, direction, t, s, workspace);
    std::size_t best = 0;
    for (std::size_t i = 0; i < batch_size && s.distance[best] < blur; ++i) {
        if (s.label[i] != static_cast<float>(c.to.index)) break;
        if (s.distance[i] > s.distance[best]) best = i;
    }
    c.t_to += t[best];
    c.p_to += t[best] * direction;
}

}  // namespace

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
            throw not_now(fmt::format(
                "rayhit->hit.primID is {}, but the geometry has {} cells; the hit belongs to another geometry",
                rayhit->hit.primID, object.cells().size()));
        PhasetreeHit found{};
        found.from = checked_phase(rayhit->hit.u, "u");
        found.to = checked_phase(rayhit->hit.v, "v");
        found.cell = rayhit->hit.primID;
        const auto [ray, placement, blur] = ray_of_hit(data, *rayhit, object_to_world);
        const FlushSubnormals flush;
        auto c = bracket(object, found.cell, ray, Phase{static_cast<std::uint8_t>(found.from)},
                         Phase{static_cast<std::uint8_t>(found.to)});
        glm::vec3 in = ray.origin + ray.far * ray.direction, out = in;
        found.tFrom = found.tTo = rayhit->ray.tfar;
        if (c) {
            move_on(*c, object.cells(), found.cell, ray.direction,
                    std::max(blur * ray.length, ulps * (glm::length(ray.origin) + ray.far)));
            in = c->p_from;
            out = c->p_to;
            found.tFrom = c->t_from / ray.length;
            found.tTo = c->t_to / ray.length;
        }
        write_point(found.pointFrom, data.motion.none() ? in : placement.point(in));
        write_point(found.pointTo, data.motion.none() ? out : placement.point(out));
        *hit = found;
    });
}

PhasetreeError phasetreeGetHitTreePoint(PhasetreeGeometry geometry, const RTCRayHit* rayhit,
                                        const float* object_to_world, float* tree_point) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(rayhit, "rayhit");
        require(tree_point, "treePoint");
        const UnitRay ray = ray_of_hit(data, *rayhit, object_to_world).ray;
        write_point(tree_point,
                    glm::vec3(glm::dvec3(ray.origin) + static_cast<double>(ray.far) * glm::dvec3(ray.direction)));
    });
}
