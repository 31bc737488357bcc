#include "caustics/trace_photon.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <variant>

#include "caustics/photon_map.hpp"
#include "caustics/photon_placement.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// Cosines in denominators are clamped to at least this, so that the power of grazing photons is bounded.
constexpr float least_divisor = 1e-4f;

// The state of one photon.
class PhotonFlight {
  public:
    PhotonFlight(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                 PathCounters& counters, const std::optional<Wavelengths>& wavelengths)
        : world_(world),
          scene_(scene),
          emitted_(emitted),
          half_length_(PhotonMap::half_length(radius)),
          sampler_(sampler),
          counters_(counters),
          of_pass_(wavelengths),
          ray_(emitted.ray),
          wavelengths_(wavelengths && wavelengths->is_spectral ? &*wavelengths : nullptr),
          power_(emitted.power) {
        // A photon of an emissive surface or medium starts on or in it, so nothing can be in between.
        if (emitted.is_of_medium || std::holds_alternative<OfEmissiveSurface>(emitted.emission.source))
            start_sees_light_ = true;
        // No sampled direction meets a point. A shadow ray meets it only if the photon's first interface is rough;
        // multiply_quotients() then replaces this 0.
        if (emitted.emission.is_of_point_light()) quotients_ = {.by_directions = 0, .by_shadow_rays = 0.0f};
    }

    void trace(TracedPhotons& traced) {
        for (bool is_first = true;; is_first = false) {
            const Hit hit = world_.geometry().intersect(ray_, counters_);
            const Surface* surface = std::get_if<Surface>(&hit);
            float distance = surface ? surface->distance : std::numeric_limits<float>::infinity();
            // A lamp with an area stops the photon. The photon's own lamp is ignored until something has changed the
            // photon's direction, because until then the photon is only leaving it.
            const LightSource own = interfaces_ == 0 ? emitted_.emission.source : LightSource{};
            if (const auto lamp = scene_.lights.area_light_in_the_way(ray_.origin, ray_.direction, distance, own)) {
                surface = nullptr;
                distance = *lamp;
            }
            // A photon is stored with its power on entering the medium. The point that gathers it applies the
            // transmittance.
            if (is_photon_chain(interfaces_)) keep_in_medium(distance, traced);
            if (!surface) return;
            if (!(is_first && emitted_.is_of_medium) && !pass_medium(distance)) return;
            if (!is_dispersed_ && surface->optics.get().disperses()) disperse();
            const Bsdf bsdf = surface->bsdf(wavelengths_);
            if (bsdf.passes_through()) {
                ray_ = surface->transmitted(ray_.direction);
                continue;
            }
            // In a mixture of a smooth and a rough material, the photon may have met the smooth one. Paths gather it
            // where they meet the rough one.
            const bool is_gathered = !bsdf.is_delta() || surface->is_partly_rough;
            if (is_photon_chain(interfaces_) && is_gathered && start_sees_light()) {
                auto& photons = has_photons_of_interfaces(*surface) ? traced.on_interfaces : traced.on_surfaces;
                photons.push_back(photon_at(surface->near_side.origin));
                // The photon was stopped here with the probability `opacity`, and so is the path that gathers it. Only
                // one of these factors belongs to the result.
                photons.back().power /= surface->opacity;
            }
            if (!continues_photons(bsdf, *surface) || !scatter(*surface, bsdf)) return;
        }
    }

  private:
    const Medium& medium() const { return clear_at(scene_, ray_.phase).interior; }

    // Multiplies the power by the transmittance of the medium. Returns false if the photon ends there.
    bool pass_medium(float distance) {
        glm::vec3 transmitted =
            transmittance(medium(), world_.geometry().way_through_medium(ray_, distance, wavelengths_), sampler_);
        if (phase_function(medium()) && !chain_survives(transmitted, sampler_)) return false;
        power_ *= transmitted;
        return power_ != glm::vec3(0.0f);
    }

    Photon photon_at(const glm::vec3& position) const {
        return {position,
                -ray_.direction,
                power_,
                emitted_.line_density,
                ray_.phase,
                emitted_.emission.source,
                -emitted_.ray.direction,
                quotients_,
                is_dispersed_};
    }

    // From here on, the photon carries the power of the hero wavelength only, in all three components. The other two
    // wavelengths of a spectral photon are dropped.
    void disperse() {
        const Wavelengths& wavelengths = of_pass_.value();
        power_ = wavelengths.is_spectral ? glm::vec3(power_.x) : for_light(power_, &wavelengths);
        wavelengths_ = &wavelengths;
        is_dispersed_ = true;
    }

    void keep_in_medium(float distance, TracedPhotons& traced) {
        const std::optional<PhotonPlacement> placement = PhotonPlacement::in(medium(), half_length_);
        if (!placement) return;
        const float depth = placement->sample(sampler_.next());
        // The point may lie up to h (half_length_) beyond the end of the photon's line, because it counts for points
        // within h, some of which are before the end.
        if (depth < distance + half_length_ && start_sees_light())
            traced.in_media.push_back({photon_at(ray_.origin + depth * ray_.direction), depth});
    }

    // Whether nothing opaque occludes the light from the photon's start. The ray is traced only for photons that are
    // stored, and only once. Thin panes in between attenuate the photon.
    bool start_sees_light() {
        if (!start_sees_light_) {
            const glm::vec3 attenuation = passed_before_start();
            start_sees_light_ = attenuation != glm::vec3(0.0f);
            power_ *= attenuation;
        }
        return *start_sees_light_;
    }
    glm::vec3 passed_before_start() {
        Ray back{emitted_.ray.origin, -emitted_.ray.direction, emitted_.ray.phase, {}, emitted_.ray.in};
        glm::vec3 passed(1.0f);
        float left = emitted_.emission.distance;
        for (int panes = 0; panes < longest_chain; ++panes) {
            const Visibility met = world_.geometry().visibility(back, left, counters_);
            if (std::holds_alternative<Escaped>(met)) return passed;
            const Surface* const surface = std::get_if<Surface>(&met);
            if (!surface) break;
            const Bsdf bsdf = surface->bsdf(wavelengths_);
            if (!bsdf.pane()) break;
            passed *= straight_through(*bsdf.pane(), *surface, back.direction);
            left = std::max(left - surface->distance, 0.0f);
            back = surface->transmitted(back.direction);
        }
        return glm::vec3(0.0f);
    }

    // Samples the photon's next direction at an interface. Returns false if it ends there.
    bool scatter(const Surface& surface, const Bsdf& bsdf) {
        const Frame frame = surface.frame();
        const glm::vec3 wo = frame.to_local(-ray_.direction);
        const float u_lobe = sampler_.next();
        // A smooth interface has no continuous pdf of directions, so it needs only the number that chooses the lobe.
        const auto next = bsdf.sample(wo, u_lobe, bsdf.is_delta() ? glm::vec2(0.0f) : sampler_.next2());
        if (!next) return false;
        if (bsdf.pane() && next->transmitted) {
            // Straight on, as if there were no interface.
            ray_ = surface.transmitted(ray_.direction);
            power_ *= next->weight;
            return power_ != glm::vec3(0.0f);
        }
        ++interfaces_;
        if (!is_photon_chain(interfaces_)) return false;
        // No shadow ray passes a mirror. If the photon met no rough surface before the mirror at which a shadow ray
        // could start, shadow rays find none of its light.
        if (!next->delta)
            multiply_quotients(surface, bsdf, ray_, wo, *next);
        else if ((!surface.far_side || bsdf.pane()) && !quotients_.by_shadow_rays)
            quotients_.by_shadow_rays = 0.0f;
        const Phase from = ray_.phase;
        const glm::vec3 direction_before = ray_.direction;
        ray_ = continued(surface, frame, *next);
        if (surface.normal != surface.geometric_normal &&
            !correct_for_shading_normal(surface, direction_before, next->transmitted))
            return false;
        // The BSDF is sampled as if the photon were a path from the camera, so its weight is for radiance that arrives
        // from `after` and leaves into `before`: a refraction scales it by (before/after)². Power is not scaled.
        // Interfaces that do not disperse, rough ones or those with a thin film, refract all light like that of the d
        // line.
        const Wavelengths* refracted_at = surface.optics.get().disperses() ? wavelengths_ : nullptr;
        const float before = clear_at(scene_, from).ior_for(refracted_at);
        const float after = clear_at(scene_, ray_.phase).ior_for(refracted_at), ratio = after / before;
        power_ *= next->weight * (ratio * ratio);
        return true;
    }

    // A path's radiance is scattered by the shading normal, but power is spread over the surface by the geometric one.
    // The quotient of the cosines for power over those for radiance is (Veach, Robust Monte Carlo Methods for Light
    // Transport Simulation, 5.3.2)
    //     |ωo·n_s| |ωi·n_g| / (|ωo·n_g| |ωi·n_s|)
    // with ωo towards where the photon comes from. Returns false if the photon would continue into the surface; its
    // light is left to paths; so is that of a photon which a thin surface transmits to the side from which it came.
    bool correct_for_shading_normal(const Surface& surface, const glm::vec3& direction_before, bool is_transmitted) {
        const glm::vec3 &shading = surface.normal, &geometric = surface.geometric_normal;
        const float side = is_transmitted ? -1.0f : 1.0f;
        const float cosine_out = side * glm::dot(ray_.direction, geometric);
        if (!(cosine_out > 0.0f)) return false;
        power_ *= -glm::dot(direction_before, shading) * cosine_out /
                  (std::max(-glm::dot(direction_before, geometric), least_divisor) *
                   std::max(side * glm::dot(ray_.direction, shading), least_divisor));
        return true;
    }

    // Multiplies the quotients (caustics/rough_chain.hpp) by that of the densities at a rough surface, where the photon
    // arrives by the ray `arriving`. Cosines are relative to the shading normal; paths use the same ones, so the
    // weights still sum to 1.
    void multiply_quotients(const Surface& surface, const Bsdf& bsdf, const Ray& arriving, const glm::vec3& wo,
                            const BsdfSample& next) {
        const Surface::Side& path_side = next.transmitted ? *surface.far_side : surface.near_side;
        const LightReceiver receiver = receiver_of_passed_light(surface, path_side);
        const float light_ior = clear_at(scene_, arriving.phase).ior;
        const float rough = rough_factor(next.pdf, light_ior, wo.z, clear_at(scene_, path_side.phase).ior, next.wi.z);
        // p_y/R: the pdf with which a camera path that arrives from next.wi continues to wo, over R.
        const float path_quotient = bsdf.reverse_pdf(wo, next.wi) / rough;
        const auto* point = std::get_if<OfPointLight>(&emitted_.emission.source);
        if (point && interfaces_ == 1) {
            // A shadow ray reaches a point light only on a straight line, and so only from the photon's first
            // interface.
            const float distance =
                emitted_.emission.distance + glm::length(surface.near_side.origin - emitted_.ray.origin);
            quotients_.by_shadow_rays = scene_.lights.point_light_probability(receiver, point->index) *
                                        squared_optical_distance(light_ior, distance) / rough;
        } else if (quotients_.by_shadow_rays) {
            quotients_.by_shadow_rays = *quotients_.by_shadow_rays * path_quotient;
        } else {
            quotients_.by_shadow_rays = scene_.lights.pdf(receiver, -arriving.direction) / rough;
        }
        quotients_.by_directions *= path_quotient;
    }

    const World& world_;
    const Scene& scene_;
    const EmittedPhoton& emitted_;
    float half_length_;
    Sampler& sampler_;
    PathCounters& counters_;
    // The wavelengths of all photons of the pass, if any.
    const std::optional<Wavelengths>& of_pass_;
    Ray ray_;
    // The wavelengths of the photon's power; null while it carries red, green and blue.
    const Wavelengths* wavelengths_;
    glm::vec3 power_;
    bool is_dispersed_ = false;
    // Counts the interfaces met so far, including the current one, except those passed without a change of direction.
    int interfaces_ = 0;
    // The densities with which the other techniques find the photon's light, relative to that of the photon.
    DensityQuotients quotients_{};
    std::optional<bool> start_sees_light_{};
};

}  // namespace

void trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                  PathCounters& counters, TracedPhotons& traced, const std::optional<Wavelengths>& wavelengths) {
    PhotonFlight(world, scene, emitted, radius, sampler, counters, wavelengths).trace(traced);
}

}  // namespace phasetree::tracer
