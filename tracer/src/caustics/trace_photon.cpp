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
          power_(emitted.power) {}

    void trace(TracedPhotons& traced) {
        for (;;) {
            const Hit hit = world_.geometry().intersect(ray_, counters_);
            const Surface* surface = std::get_if<Surface>(&hit);
            const float distance = surface ? surface->distance : std::numeric_limits<float>::infinity();
            // With the power with which it came into the medium: how much is left at a point depends on the point.
            if (links_ > 0) keep_in_medium(distance, traced);
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
            if (!is_link(bsdf, *surface)) {
                if (links_ > 0 && is_lit_by_photons(*surface, bsdf) && came_from_light())
                    traced.on_surfaces.push_back(photon_at(surface->near_side.origin));
                return;
            }
            if (++links_ > longest_chain || !pass(*surface, bsdf)) return;
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
                emitted_.emission,
                -emitted_.ray.direction,
                single_ != nullptr};
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
        // A smooth interface has no lobe in which a direction would be chosen by the two numbers.
        const auto next = bsdf.sample(frame.to_local(-ray_.direction), sampler_.next(), glm::vec2(0.0f));
        if (!next) return false;
        const float before = clear_at(scene_, ray_.phase).ior_for(single_);
        ray_ = continued(surface, frame, *next);
        // The BSDF is sampled as if the photon were a path that comes from the camera, so its weight is of radiance
        // that arrives from `after` and leaves into `before`: a refraction scales it by (before/after)². Power is not
        // scaled.
        const float after = clear_at(scene_, ray_.phase).ior_for(single_), ratio = after / before;
        power_ *= for_light(next->weight, single_) * (ratio * ratio);
        return true;
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
    int links_ = 0;                       // how many interfaces have reflected or refracted it
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
