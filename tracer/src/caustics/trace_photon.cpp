#include "caustics/trace_photon.hpp"

#include <algorithm>
#include <limits>

#include "caustics/photon_map.hpp"
#include "caustics/photon_placement.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// A smaller cosine than this counts as this where it divides.
constexpr float least_flat_cosine = 1e-4f;

// Follows one photon until it ends.
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
          wavelengths_(wavelengths),
          ray_(emitted.ray),
          spectral_(wavelengths && wavelengths->is_spectral ? &*wavelengths : nullptr),
          power_(emitted.power) {
        // A photon of a glowing surface starts at that surface.
        if (std::holds_alternative<OfGlowingSurface>(emitted.emission.source)) is_lit_ = true;
        // A sampled direction never meets a point, and a shadow ray does not meet it through what bends light.
        if (emitted.emission.is_of_point_light()) quotients_ = {.by_directions = 0, .by_shadow_rays = 0.0f};
    }

    void trace(TracedPhotons& traced) {
        for (;;) {
            const Hit hit = world_.geometry().intersect(ray_, counters_);
            const Surface* surface = std::get_if<Surface>(&hit);
            float distance = surface ? surface->distance : std::numeric_limits<float>::infinity();
            // Lamps with an extent hide what is behind them. The photon's own lamp can do so once something has bent
            // the photon's way.
            const LightSource own = interfaces_ == 0 ? emitted_.emission.source : LightSource{};
            if (const auto lamp = scene_.lights.area_light_in_the_way(ray_.origin, ray_.direction, distance, own)) {
                surface = nullptr;
                distance = *lamp;
            }
            // A photon is kept with the power with which it came into the medium. The point that gathers it knows how
            // much of that is left there.
            if (photons_follow(interfaces_)) keep_in_medium(distance, traced);
            if (!surface) return;
            glm::vec3 left = transmittance(medium(), {ray_.origin, ray_.direction, distance, spectral_}, sampler_);
            if (phase_function(medium()) && !chain_survives(left, sampler_)) return;
            power_ *= left;
            if (power_ == glm::vec3(0.0f)) return;
            if (!is_dispersed_ && surface->optics.get().disperses()) disperse();
            const Bsdf bsdf = surface->bsdf(spectral_);
            if (bsdf.passes_through()) {
                ray_ = surface->transmitted(ray_.direction);
                continue;
            }
            if (photons_follow(interfaces_) && !bsdf.is_delta() && is_lit()) {
                auto& photons = surface->far_side ? traced.on_interfaces : traced.on_surfaces;
                photons.push_back(photon_at(surface->near_side.origin));
            }
            if (!sends_photons_on(bsdf, *surface)) return;
            if (!photons_follow(++interfaces_) || !scatter(*surface, bsdf)) return;
        }
    }

  private:
    const Medium& medium() const { return clear_at(scene_, ray_.phase).interior; }

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

    // From here on the photon stands for the hero alone. Of a photon of three wavelengths only the first number counts.
    void disperse() {
        const Wavelengths& wavelengths = wavelengths_.value();
        power_ = wavelengths.is_spectral ? glm::vec3(power_.x) : for_light(power_, &wavelengths);
        spectral_ = &wavelengths;
        is_dispersed_ = true;
    }

    void keep_in_medium(float distance, TracedPhotons& traced) {
        const std::optional<PhotonPlacement> placement = PhotonPlacement::in(medium(), half_length_);
        if (!placement) return;
        const float depth = placement->sample(sampler_.next());
        // The place may lie up to h (half_length_) beyond the end of the photon's line, because it lights points within
        // h around it, of which some are before the end.
        if (depth < distance + half_length_ && is_lit())
            traced.in_media.push_back({photon_at(ray_.origin + depth * ray_.direction), depth});
    }

    // Whether light comes to where the photon started, with nothing in between. It is looked up once, and only of
    // photons that are kept.
    bool is_lit() {
        if (!is_lit_) {
            const Ray back{emitted_.ray.origin, -emitted_.ray.direction, emitted_.ray.phase, {}, emitted_.ray.in};
            const Visibility light = world_.geometry().visibility(back, emitted_.emission.distance, counters_);
            is_lit_ = std::holds_alternative<Escaped>(light);
        }
        return *is_lit_;
    }

    // Sends the photon on from an interface, into one of its directions. Returns false if it ends there.
    bool scatter(const Surface& surface, const Bsdf& bsdf) {
        const Frame frame(surface.normal);
        const glm::vec3 wo = frame.to_local(-ray_.direction);
        const float u_lobe = sampler_.next();
        // A smooth interface has no density of directions, so it needs no second pair of numbers.
        const auto next = bsdf.sample(wo, u_lobe, bsdf.is_delta() ? glm::vec2(0.0f) : sampler_.next2());
        if (!next) return false;
        // Shadow rays do not pass a mirror, so they find nothing of this photon unless they start at a rough surface
        // that it met before.
        if (!next->delta)
            multiply_quotients(surface, bsdf, ray_, wo, *next);
        else if (!surface.far_side && !quotients_.by_shadow_rays)
            quotients_.by_shadow_rays = 0.0f;
        const Phase from = ray_.phase;
        const glm::vec3 in = ray_.direction;
        ray_ = continued(surface, frame, *next);
        if (surface.normal != surface.geometric_normal && !spread_by_shading_normal(surface, in)) return false;
        // The BSDF is sampled as if the photon were a path that comes from the camera, so its weight is of radiance
        // that arrives from `after` and leaves into `before`: a refraction scales it by (before/after)². Power is not
        // scaled. What does not disperse, a rough interface or one with a film, bends all light as that of the d line.
        const Wavelengths* bent_as = surface.optics.get().disperses() ? spectral_ : nullptr;
        const float before = clear_at(scene_, from).ior_for(bent_as);
        const float after = clear_at(scene_, ray_.phase).ior_for(bent_as), ratio = after / before;
        power_ *= next->weight * (ratio * ratio);
        return true;
    }

    // A path's radiance is scattered by the shading normal, and power is spread over the surface by the geometric one.
    // The quotient of the cosines for power over those for radiance is (Veach, Robust Monte Carlo Methods for Light
    // Transport Simulation, 5.3.2)
    //     |ωo·n_s| |ωi·n_g| / (|ωo·n_g| |ωi·n_s|)
    // with ωo to where the photon comes from. Returns false if the photon would go on into the surface: paths find such
    // light, and photons do not.
    bool spread_by_shading_normal(const Surface& surface, const glm::vec3& in) {
        const glm::vec3 &shading = surface.normal, &flat = surface.geometric_normal;
        const float out = glm::dot(ray_.direction, flat);
        if (!(out > 0.0f)) return false;
        power_ *= -glm::dot(in, shading) * out /
                  (std::max(-glm::dot(in, flat), least_flat_cosine) *
                   std::max(glm::dot(ray_.direction, shading), least_flat_cosine));
        return true;
    }

    // Multiplies the quotients by the quotient of densities at a rough surface, on which the photon arrives by the ray
    // `in`. Cosines are those to the shading normal; paths take the same, so the weights still sum to 1.
    void multiply_quotients(const Surface& surface, const Bsdf& bsdf, const Ray& in, const glm::vec3& wo,
                            const BsdfSample& next) {
        const Surface::Side& path_side = next.transmitted ? *surface.far_side : surface.near_side;
        const LightReceiver receiver = receiver_of_passed_light(surface, path_side);
        const float lamp_ior = clear_at(scene_, in.phase).ior;
        const float photon_density =
            rough_factor(next.pdf, lamp_ior, wo.z, clear_at(scene_, path_side.phase).ior, next.wi.z);
        // The density of a path that comes the other way, over the photon's; it has next.wi where the photon has wo.
        const float path_quotient = bsdf.reverse_pdf(wo, next.wi) / photon_density;
        const auto* point = std::get_if<OfPointLight>(&emitted_.emission.source);
        if (point && interfaces_ == 1) {
            // A shadow ray reaches a point light on a straight line alone, so only from the photon's first interface.
            const float distance =
                emitted_.emission.distance + glm::length(surface.near_side.origin - emitted_.ray.origin);
            quotients_.by_shadow_rays = scene_.lights.point_light_probability(receiver, point->index) *
                                        squared_optical_distance(lamp_ior, distance) / photon_density;
        } else if (quotients_.by_shadow_rays) {
            quotients_.by_shadow_rays = *quotients_.by_shadow_rays * path_quotient;
        } else {
            quotients_.by_shadow_rays = scene_.lights.pdf(receiver, -in.direction) / photon_density;
        }
        quotients_.by_directions *= path_quotient;
    }

    const World& world_;
    const Scene& scene_;
    const EmittedPhoton& emitted_;
    float half_length_;
    Sampler& sampler_;
    PathCounters& counters_;
    const std::optional<Wavelengths>& wavelengths_;
    Ray ray_;
    // The wavelengths whose power the photon carries; null if it carries red, green and blue.
    const Wavelengths* spectral_;
    glm::vec3 power_;
    bool is_dispersed_ = false;
    // How many interfaces it has met, the present one included, but for those that it passes straight.
    int interfaces_ = 0;
    // How likely the other techniques are to find the photon's light, relative to the photon itself.
    DensityQuotients quotients_{};
    std::optional<bool> is_lit_{};
};

}  // namespace

void trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                  PathCounters& counters, TracedPhotons& traced, const std::optional<Wavelengths>& wavelengths) {
    PhotonFlight(world, scene, emitted, radius, sampler, counters, wavelengths).trace(traced);
}

}  // namespace phasetree::tracer
