#include "caustics/trace_photon.hpp"

#include <limits>

#include "world/chain.hpp"

namespace phasetree::tracer {

bool is_lit_by_photons(const Surface& surface, const Bsdf& bsdf) {
    return !surface.far_side && !bsdf.is_delta();
}

std::optional<Photon> trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted,
                                   Sampler& sampler, PathCounters& counters,
                                   const std::optional<Wavelength>& wavelength) {
    const Wavelength* only = nullptr;
    Ray ray = emitted.ray;
    glm::vec3 power = emitted.power;
    for (int length = 0;;) {
        const Hit hit = world.geometry().intersect(ray, counters);
        const Surface* surface = std::get_if<Surface>(&hit);
        if (!surface) return std::nullopt;
        power *= transmittance(clear_at(scene, ray.phase).interior,
                               {ray.origin, ray.direction, surface->distance, only}, sampler);
        if (!only && surface->optics.get().disperses()) {
            only = &wavelength.value();
            power = for_light(power, only);
        }
        const Bsdf bsdf = surface->bsdf(only);
        if (bsdf.passes_through()) {
            ray = surface->transmitted(ray.direction);
            continue;
        }
        if (!is_link(bsdf, *surface)) {
            if (length == 0 || !is_lit_by_photons(*surface, bsdf)) return std::nullopt;
            const Ray back{emitted.ray.origin, -emitted.ray.direction, emitted.ray.phase, {}, emitted.ray.in};
            const Visibility light = world.geometry().visibility(back, emitted.emission.distance, counters);
            if (!std::holds_alternative<Escaped>(light)) return std::nullopt;
            return Photon{surface->near_side.origin,
                          -ray.direction,
                          power,
                          emitted.line_density,
                          ray.phase,
                          emitted.emission,
                          back.direction,
                          emitted.of_point_light,
                          only != nullptr};
        }
        if (++length > longest_chain) return std::nullopt;
        const Frame frame(surface->normal);
        const auto next = bsdf.sample(frame.to_local(-ray.direction), sampler.next(), glm::vec2(0.0f));
        if (!next) return std::nullopt;
        const float before = clear_at(scene, ray.phase).ior_for(only);
        ray = continued(*surface, frame, *next);
        // A BSDF's weight is of radiance, which a refraction scales by the squared quotient of the indices; power is
        // not scaled.
        const float after = clear_at(scene, ray.phase).ior_for(only), ratio = after / before;
        power *= for_light(next->weight, only) * (ratio * ratio);
    }
}

}  // namespace phasetree::tracer
