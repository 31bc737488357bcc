#include "caustics/trace_photon.hpp"

#include <limits>

#include "caustics/photon_map.hpp"
#include "caustics/photon_placement.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// One photon on its way.
class PhotonFlight {
  public:
    PhotonFlight(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                 PathCounters& counters, const std::optional<Wavelength>& wavelength)
        : world_(world),
          scene_(scene),
          emitted_(emitted),
          half_length_(PhotonMap::half_length(radius)),
          sampler_(sampler),
          counters_(counters),
          wavelength_(wavelength),
          ray_(emitted.ray),
          power_(emitted.power) {
        if (emitted.emission.is_of_point_light()) rough_ = {.by_directions = 0, .by_shadow_rays = 0.0f};
    }

    void trace(TracedPhotons& traced) {
        for (;;) {
            const Hit hit = world_.geometry().intersect(ray_, counters_);
            const Surface* surface = std::get_if<Surface>(&hit);
            float distance = surface ? surface->distance : std::numeric_limits<float>::infinity();
            // Lamps hide what is behind them.
            if (const auto lamp = scene_.lights.area_light_seen(ray_.origin, ray_.direction, distance, false)) {
                surface = nullptr;
                distance = lamp->distance;
            }
            // With the power with which it came into the medium: how much is left at a point depends on the point.
            if (interfaces_ > 0) keep_in_medium(distance, traced);
            if (!surface) return;
            glm::vec3 left = transmittance(medium(), {ray_.origin, ray_.direction, distance, single_}, sampler_);
            if (phase_function(medium()) && !chain_survives(left, sampler_)) return;
            power_ *= left;
            if (!single_ && surface->optics.get().disperses()) {
                single_ = &wavelength_.value();
                power_ = for_light(power_, single_);
            }
            const Bsdf bsdf = surface->bsdf(single_);
            if (bsdf.passes_through()) {
                ray_ = surface->transmitted(ray_.direction);
                continue;
            }
            if (!surface->far_side) {
                if (interfaces_ > 0 && is_lit_by_photons(*surface, bsdf) && came_from_light())
                    traced.on_surfaces.push_back(photon_at(surface->near_side.origin));
                return;
            }
            if (++interfaces_ > longest_chain || !pass(*surface, bsdf)) return;
        }
    }

  private:
    const Medium& medium() const { return clear_at(scene_, ray_.phase).interior; }

    Photon photon_at(const glm::vec3& position) const {
        return {position,          -ray_.direction,         power_, emitted_.line_density, ray_.phase,
                emitted_.emission, -emitted_.ray.direction, rough_, single_ != nullptr};
    }

    void keep_in_medium(float distance, TracedPhotons& traced) {
        const std::optional<PhotonPlacement> placement = PhotonPlacement::in(medium(), half_length_);
        if (!placement) return;
        const float depth = placement->sample(sampler_.next());
        // Places up to h behind the line's end count for points before it.
        if (depth < distance + half_length_ && came_from_light())
            traced.in_media.push_back({photon_at(ray_.origin + depth * ray_.direction), depth});
    }

    // Whether nothing is between where the photon started and its light.
    bool came_from_light() {
        if (!came_from_light_) {
            const Ray back{emitted_.ray.origin, -emitted_.ray.direction, emitted_.ray.phase, {}, emitted_.ray.in};
            const Visibility light = world_.geometry().visibility(back, emitted_.emission.distance, counters_);
            came_from_light_ = std::holds_alternative<Escaped>(light);
        }
        return *came_from_light_;
    }

    // Reflects or refracts the photon. False if it ends there.
    bool pass(const Surface& surface, const Bsdf& bsdf) {
        const Frame frame(surface.normal);
        const glm::vec3 wo = frame.to_local(-ray_.direction);
        const float lobe = sampler_.next();
        // A smooth interface has no lobe in which a direction would be chosen by the two numbers.
        const auto next = bsdf.sample(wo, lobe, bsdf.is_delta() ? glm::vec2(0.0f) : sampler_.next2());
        if (!next) return false;
        // What does not disperse, a rough interface or one with a film, bends all light as that of the d line.
        const Wavelength* bent_as = surface.optics.get().disperses() ? single_ : nullptr;
        const float before = clear_at(scene_, ray_.phase).ior_for(bent_as);
        if (!next->delta) add_rough_interface(surface, bsdf, wo, *next);
        ray_ = continued(surface, frame, *next);
        // The BSDF is sampled as if the photon were a path that comes from the camera, so its weight is of radiance
        // that arrives from `after` and leaves into `before`: a refraction scales it by (before/after)². Power is not
        // scaled.
        const float after = clear_at(scene_, ray_.phase).ior_for(bent_as), ratio = after / before;
        power_ *= for_light(next->weight, single_) * (ratio * ratio);
        return true;
    }

    // Multiplies how a path finds the photon's chain by what this rough interface adds. To be called before the ray
    // changes, for the direction from which the photon comes counts.
    void add_rough_interface(const Surface& surface, const Bsdf& bsdf, const glm::vec3& wo, const BsdfSample& next) {
        const Surface::Side& path_side = next.transmitted ? *surface.far_side : surface.near_side;
        const float lamp_ior = clear_at(scene_, ray_.phase).ior;
        const float factor = rough_factor(next.pdf, lamp_ior, wo.z, clear_at(scene_, path_side.phase).ior, next.wi.z);
        // The path arrives along next.wi and leaves along wo.
        const float backwards = bsdf.reverse_pdf(wo, next.wi) / factor;
        if (has_met_rough_) {
            rough_.by_shadow_rays = *rough_.by_shadow_rays * backwards;
        } else if (const auto* point = std::get_if<OfPointLight>(&emitted_.emission.source)) {
            // A shadow ray gets to a point on a straight line alone, so this must be the photon's first interface.
            if (interfaces_ == 1) {
                const float distance = lamp_ior * (emitted_.emission.distance +
                                                   glm::length(surface.near_side.origin - emitted_.ray.origin));
                rough_.by_shadow_rays = scene_.lights.point_light_probability(path_side.origin, point->index) *
                                        (distance * distance) / factor;
            }
        } else {
            rough_.by_shadow_rays = scene_.lights.pdf(path_side.origin, -ray_.direction) / factor;
        }
        has_met_rough_ = true;
        rough_.by_directions *= backwards;
    }

    const World& world_;
    const Scene& scene_;
    const EmittedPhoton& emitted_;
    float half_length_;
    Sampler& sampler_;
    PathCounters& counters_;
    const std::optional<Wavelength>& wavelength_;
    Ray ray_;
    glm::vec3 power_;
    const Wavelength* single_ = nullptr;  // the wavelength from the first interface that disperses on
    int interfaces_ = 0;                  // how many interfaces have reflected or refracted it
    bool has_met_rough_ = false;
    PathDensities rough_{};
    std::optional<bool> came_from_light_{};
};

}  // namespace

bool is_lit_by_photons(const Surface& surface, const Bsdf& bsdf) {
    return !surface.far_side && !bsdf.is_delta();
}

void trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                  PathCounters& counters, TracedPhotons& traced, const std::optional<Wavelength>& wavelength) {
    PhotonFlight(world, scene, emitted, radius, sampler, counters, wavelength).trace(traced);
}

}  // namespace phasetree::tracer
