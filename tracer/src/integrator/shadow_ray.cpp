#include "integrator/shadow_ray.hpp"

#include <algorithm>

#include "caustics/emission.hpp"
#include "caustics/rough_chain.hpp"
#include "integrator/line_density.hpp"
#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// Arrival::FromLight::line_density of a point light that is seen without refraction.
float point_density(const PathContext& context, const Ray& ray, const LightSample& sampled, const OfPointLight& light) {
    if (!context.photons) return 0.0f;
    return context.photons.emission->direction_density(light.index, -ray.direction) /
           squared_optical_distance(clear_at(context.scene, ray.phase).ior, sampled.distance);
}

}  // namespace

Arrival trace_shadow_ray(const PathContext& context, Ray ray, const LightSample& sampled,
                         const PathWavelengths& path_wavelengths, int interfaces_before) {
    const auto density_at_end = [&](int length, const Surface* emissive) {
        if (!is_photon_chain(interfaces_before + length)) return 0.0f;
        if (emissive) return line_density(context.photons, ray, *emissive);
        const auto* point = std::get_if<OfPointLight>(&sampled.source);
        return point ? point_density(context, ray, sampled, *point) : line_density(context.photons, ray);
    };
    PathWavelengths ray_wavelengths = path_wavelengths;
    // The light's radiance was sampled in the path's representation. If that is RGB, an interface that the ray went
    // straight through may have dispersed the ray since, and the radiance must be converted to its wavelengths.
    const auto sampled_radiance = [&] {
        return path_wavelengths.now() ? sampled.radiance : for_light(sampled.radiance, ray_wavelengths.now());
    };
    Arrival arrival;
    glm::vec3 throughput(1.0f);
    // The distance of the sampled light from the ray's origin while the ray is straight.
    float to_sampled = sampled.distance;
    for (int length = 0, segment = 0;; ++segment) {
        // Find what is in the way of the segment.
        const bool is_straight = segment == 0 || (sampled.is_of_point_light() && length == 0);
        const float far = is_straight ? to_sampled : Bounds::infinity;
        const Visibility met = context.world.geometry().visibility(ray, far, context.counters);
        const Surface* surface = std::get_if<Surface>(&met);
        const Blocked* blocked = std::get_if<Blocked>(&met);
        const bool escaped = !surface && !blocked;
        const float distance = surface ? surface->distance : blocked ? blocked->distance : Bounds::infinity;
        if (segment == 0) arrival.to_boundary = distance;

        // Find the light that the segment reaches: a lamp, what is behind everything, or an emissive surface.
        const Surface* emissive =
            blocked && blocked->emissive && !sampled.is_of_point_light() ? &*blocked->emissive : nullptr;
        std::optional<Lights::Emission> light;
        if (!is_straight)
            light = context.scene.lights.seen(ray.origin, ray.direction, distance, false, ray_wavelengths.now());
        else if (escaped)
            light = Lights::Emission{to_sampled, sampled_radiance(), sampled.source};
        if (light) emissive = nullptr;  // a lamp is in front of it
        if (const auto emitted = emissive ? emissive->emitted(ray_wavelengths.now()) : std::nullopt)
            light = Lights::Emission{distance, emitted->radiance, OfEmissiveSurface{emitted->group}};

        // Pass the medium.
        const Medium& medium = clear_at(context.scene, ray.phase).interior;
        const bool brings_emission = is_emissive(medium) && !sampled.is_of_point_light();
        const bool is_dark = light ? light->radiance == glm::vec3(0.0f) : !surface;
        if (is_dark && !brings_emission) return arrival;
        const float way = light ? light->distance : distance;
        const Passage passage =
            pass(medium, context.world.geometry().way_through_medium(ray, way, ray_wavelengths.now()), context.sampler);
        const bool is_dispersed_here = ray_wavelengths.is_dispersed() && !path_wavelengths.is_dispersed();
        const glm::vec3 to_path = is_dispersed_here ? ray_wavelengths.all()->hero_to_all : glm::vec3(1.0f);
        if (brings_emission && passage.emitted != glm::vec3(0.0f))
            arrival.from_media.push_back(
                {throughput * passage.emitted * to_path, is_photon_chain(interfaces_before + length)
                                                             ? line_density_in_medium(context.photons, ray, way)
                                                             : 0.0f});
        throughput *= passage.left;
        if (is_dark || throughput == glm::vec3(0.0f)) return arrival;

        // End at the light.
        if (light) {
            throughput *= to_path;
            arrival.light = Arrival::FromLight{throughput * light->radiance, light->source, ray.direction,
                                               density_at_end(length, emissive)};
            return arrival;
        }

        // Continue through the interface, if it is smooth: straight on, reflected or refracted.
        if (phase_function(medium) && !chain_survives(throughput, context.sampler)) return arrival;
        if (surface->optics.get().disperses()) ray_wavelengths.disperse();
        const Bsdf bsdf = surface->bsdf(ray_wavelengths.now());
        const ThinPane* const pane = bsdf.pane();
        if (pane || bsdf.passes_through()) {
            if (pane) throughput *= straight_through(*pane, *surface, ray.direction);
            if (throughput == glm::vec3(0.0f)) return arrival;
            to_sampled = std::max(to_sampled - distance, 0.0f);
            ray = surface->transmitted(ray.direction);
            continue;
        }
        if (sampled.is_of_point_light() || !is_link(bsdf, *surface) || ++length > longest_chain) return arrival;
        const Frame frame = surface->frame();
        // A smooth interface has no lobe to sample a direction from, so the two numbers do not matter.
        const auto next = bsdf.sample(frame.to_local(-ray.direction), context.sampler.next(), glm::vec2(0.0f));
        if (!next) return arrival;
        throughput *= next->weight;
        ray = continued(*surface, frame, *next);
        if (!moves_away(*surface, ray.direction, next->transmitted)) return arrival;
    }
}

}  // namespace phasetree::tracer
