// Traces rays through several objects.
//
// Each object has an interface to the vacuum around it. Where two objects touch, a ray leaves one and enters the other,
// and should see a single interface between both phases. Cells know their interfaces up to a resolution, and
// coordinates are rounded, so the two interfaces are found slightly apart, and in either order. They count as one if
// their distance across the interface is at most the sum of the two objects' tolerances (PlacedGeometry::tolerance). A
// ray that leaves such an interface starts displaced from it by that distance, so that its phase in either object is
// unambiguous. So an object, or a gap between two, that is thinner than that distance along the ray may be missed.
// Interfaces of more than two objects at one point are joined in pairs.
//
// Objects should not overlap. Where they do, the first of those that contain a point is there, and the interfaces of
// the others are invisible.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "world/bumps_and_grain.hpp"
#include "world/traced_geometry.hpp"

namespace phasetree::tracer {

namespace {

// A tolerance is measured across an interface, but the search is along the ray. At grazing incidence, the distance
// along the ray could be arbitrarily long, so the cosine between them is at least this.
constexpr double least_cosine = 1.0 / 64;

// A ray passes at most this many invisible interfaces within a tolerance, so that it ends even where thousands of
// copies are at one point. The number over the whole ray is not limited.
constexpr int most_unseen_at_one_place = 1000;

std::array<embree::CarriedPhase, RayObjects::most> carried(const RayObjects& in) {
    std::array<embree::CarriedPhase, RayObjects::most> all;
    for (std::size_t i = 0; i < in.size(); ++i) {
        all[i].object.geometry = 0;
        all[i].object.instances[0] = in.copy(i);
        all[i].phase = in.phase(i);
    }
    return all;
}

}  // namespace

Way TracedGeometry::way_through_medium(const Ray& ray, float length, const Wavelengths* wavelengths) const {
    const Way in_scene{ray.origin, ray.direction, length, wavelengths};
    if (!placed_ || ray.in.size() == 0) return in_scene;
    const Clear* clear = std::get_if<Clear>(&scene_.materials[ray.phase.index]);
    if (!clear || !std::holds_alternative<VaryingMedium>(clear->interior)) return in_scene;
    const Transform to_object = placed_->to_object(ray.in.copy(0), ray.in.time());
    return {glm::vec3(to_object(glm::dvec3(ray.origin))), glm::vec3(to_object.matrix * glm::dvec3(ray.direction)),
            length, wavelengths};
}

TracedGeometry::NextOfSeveral TracedGeometry::next_of_several(const Ray& ray, float far, PathCounters& counters) const {
    const auto phases = carried(ray.in);
    PlacedQuery q;
    q.query.carried = std::span(phases).first(ray.in.size());
    q.query.default_phase = phasetree::vacuum;
    q.query.start = ray.hint;
    q.start = ray.start;
    q.far = far;
    q.time = static_cast<double>(ray.in.time());
    q.origin = glm::dvec3(ray.origin);
    q.direction = glm::dvec3(ray.direction);
    RTCRayHit hit = rayhit_of(ray, 0, far);
    find_closest_hit(q.query, hit);
    if (q.query.is_out_of_memory) throw std::bad_alloc();
    ++counters.rays;
    counters.trace.visits += q.query.counters.visits;
    counters.trace.batches += q.query.counters.batches;
    counters.trace.phantoms += q.query.counters.phantoms;
    if (!embree::is_hit(hit)) return Escaped{};
    if (hit.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) return hit;
    const CrossingInScene found = crossing_in_scene(q, hit);
    const auto mesh =
        mesh_flush_with_interface(ray, found.crossing.to, static_cast<float>(found.distance), found.p_from, found.p_to);
    if (mesh) return *mesh;
    return found;
}

TracedGeometry::CrossingInScene TracedGeometry::crossing_in_scene(const PlacedQuery& query,
                                                                  const RTCRayHit& hit) const {
    const Crossing& c = query.query.crossing;
    const Transform& to_object = query.hit.to_object;
    const Transform to_scene = to_object.inverse();
    const glm::vec3 direction(glm::normalize(to_object.matrix * query.direction));
    const CrossingNormal normal = cells_[query.hit.object]->normal(hit.hit.primID, c, direction);
    const glm::vec3 p_from(to_scene(c.p_from));
    return {.crossing = c,
            .copy = query.hit,
            .hint = {embree::ObjectInstance::of(hit.hit), hit.hit.primID, c.from, normal.gradient},
            .distance = static_cast<double>(hit.ray.tfar),
            .p_from = p_from,
            .p_to = glm::vec3(to_scene(c.p_to)),
            .normal = glm::vec3(glm::normalize(-glm::dvec3(normal.unit) * to_object.matrix)),
            .normal_in_object = -normal.unit,
            .tolerance = placed_->tolerance(query.hit.object, to_scene, p_from)};
}

// Determines what lies behind a crossing, and the second crossing that belongs to it, if any: the start of another
// object where the ray leaves the last one that contained it, or the end of an object that contained it where it enters
// another.
TracedGeometry::Met TracedGeometry::with_what_touches(const Ray& ray, const CrossingInScene& first,
                                                      PathCounters& counters) const {
    Met met{first, std::nullopt, ray.in};
    met.behind.set(first.copy.number, first.crossing.to);
    const bool leaves = met.behind.size() == 0;
    const bool enters = met.behind.size() > ray.in.size();
    if (ray.in.size() == 0 || !(leaves || enters)) return met;
    const double cosine = std::max(std::abs(static_cast<double>(glm::dot(first.normal, ray.direction))), least_cosine);
    const auto far = static_cast<float>((first.tolerance + placed_->most_tolerance()) / cosine);
    const NextOfSeveral next = next_of_several(behind(ray, met), far, counters);
    const auto* second = std::get_if<CrossingInScene>(&next);
    if (!second || second->copy.number == first.copy.number) return met;
    if (second->distance * cosine > first.tolerance + second->tolerance) return met;
    if (leaves ? second->crossing.from != phasetree::vacuum : second->crossing.to != phasetree::vacuum) return met;
    met.behind.set(second->copy.number, second->crossing.to);
    met.joined = *second;
    met.joined->distance += first.distance;
    return met;
}

Ray TracedGeometry::behind(const Ray& ray, const Met& met) {
    const CrossingInScene& last = met.joined ? *met.joined : met.first;
    Ray on{last.p_to, ray.direction, met.behind.phase(), {}, met.behind, std::nullopt};
    if (met.joined) {
        on.origin -= static_cast<float>(met.apart()) * met.first.normal;
    } else {
        on.hint = last.hint;
        on.start = StartInCopy{last.copy.number, last.crossing.p_to};
    }
    return on;
}

Surface TracedGeometry::surface_of_several(const Ray& ray, const Met& met, double distance) const {
    const CrossingInScene& first = met.first;
    const Phase from = ray.in.phase(), to = met.behind.phase();
    // The ray meets the object that it enters; its start may be found before the end of the other. If the ray enters
    // none, it meets the one that it leaves.
    const CrossingInScene& shown = met.joined && met.joined->crossing.to != phasetree::vacuum ? *met.joined : first;
    const auto [outside, inside] = from == to ? std::pair(phasetree::vacuum, phasetree::vacuum) : std::pair(from, to);
    Surface surface{.distance = static_cast<float>(distance),
                    .normal = first.normal,
                    .geometric_normal = first.normal,
                    .near_side = {first.p_from, from, ray.in, std::nullopt},
                    .far_side = std::nullopt,
                    .optics = interfaces_.between(outside.index, inside.index),
                    .hint = {},
                    .object = shown.copy.object,
                    .entered = to,
                    .place = {shown.crossing.p_from, shown.normal_in_object, std::nullopt}};
    surface.place.copy = shown.copy.number;
    const Ray on = behind(ray, met);
    if (met.joined) {
        surface.near_side.origin += static_cast<float>(met.apart()) * first.normal;
    } else {
        surface.hint = first.hint;
        surface.near_side.start = StartInCopy{first.copy.number, first.crossing.p_from};
    }
    if (is_clear(scene_.materials[to.index])) surface.far_side = {on.origin, to, on.in, on.start};
    choose_of_mixture(surface);
    add_bumps_and_grain(surface, ray.direction, FromCopyToScene{shown.copy.to_object});
    return surface;
}

Hit TracedGeometry::intersect_several(const Ray& ray, float far, PathCounters& counters) const {
    Ray rest = ray;
    double travelled = 0, place = 0;
    for (int unseen = 0; unseen < most_unseen_at_one_place; ++unseen) {
        const float left = std::isfinite(far) ? static_cast<float>(static_cast<double>(far) - travelled) : far;
        if (!(left > 0)) break;
        const NextOfSeveral next = next_of_several(rest, left, counters);
        if (std::holds_alternative<Escaped>(next)) break;
        if (const auto* hit = std::get_if<RTCRayHit>(&next)) {
            Surface surface = surface_of_mesh(rest, *hit);
            surface.distance = static_cast<float>(travelled + static_cast<double>(surface.distance));
            return surface;
        }
        const Met met = with_what_touches(rest, std::get<CrossingInScene>(next), counters);
        // A scattered path continues in the objects that contain its ray, and a varying density is in the space of each
        // object. So within a phase that scatters or varies, which both have a phase function, a transition from one
        // object to another is reported to the path as a surface without effect.
        const Phase from = rest.in.phase(), to = met.behind.phase();
        if (from != to || phase_function(std::get<Clear>(scene_.materials[from.index]).interior))
            return surface_of_several(rest, met, travelled + met.first.distance);
        const Ray on = behind(rest, met);
        travelled += glm::dot(glm::dvec3(on.origin) - glm::dvec3(rest.origin), glm::dvec3(ray.direction));
        rest = on;
        if (travelled - place > placed_->most_tolerance()) {
            place = travelled;
            unseen = 0;
        }
    }
    return Escaped{};
}

}  // namespace phasetree::tracer
