#include "integrator/next_event_estimation.hpp"

#include "integrator/shadow_ray.hpp"
#include "integrator/technique_weight.hpp"

namespace phasetree::tracer {

void add_light_of_shadow_ray(const PathContext& context, const PathState& path, const LightSample& light,
                             const Scattering& scattering, int interfaces_before, PathRadiance& radiance) {
    const Techniques techniques = context.scene.settings.techniques;
    if (techniques == Techniques::directions_alone) return;
    PhotonDensity by_photons = scattering.by_photons;
    // Without photons, shadow rays do not evaluate line densities.
    PathContext of_ray = context;
    if (!(by_photons.per_line_density > 0.0f)) of_ray.photons = {};
    const Arrival arrival = trace_shadow_ray(of_ray, scattering.ray, light, path.wavelengths, interfaces_before);
    // A direction sampled by the path hits a point light with probability 0.
    const float by_directions = light.is_of_point_light() ? 0.0f : scattering.pdf;
    const auto add = [&](const glm::vec3& found, float line_density, const LightSource& source,
                         const glm::vec3& direction) {
        // Photons reach a medium through its boundary. A shadow ray that meets no boundary has line density 0 and an
        // infinite distance to the boundary, for which coverage is undefined.
        if (line_density > 0.0f) by_photons.reach_boundary(arrival.to_boundary);
        const float weight = technique_weight(techniques, Technique::shadow_rays, light.pdf, by_directions,
                                              by_photons.per_line_density * line_density);
        radiance.add(path.throughput * scattering.f * found * (weight / light.pdf), path.wavelengths.now(), source,
                     direction, true);
    };
    for (const auto& [found, line_density] : arrival.from_media) add(found, line_density, Background{}, light.wi);
    if (arrival.light)
        add(arrival.light->radiance, arrival.light->line_density, arrival.light->source, arrival.light->direction);
}

}  // namespace phasetree::tracer
