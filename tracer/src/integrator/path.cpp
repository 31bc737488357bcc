#include "integrator/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/light_proposal.hpp"
#include "integrator/path_recorder.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

float power_heuristic(float a, float b) {
    // The square of the quotient does not overflow where a² could.
    const float q = b / a;
    return 1.0f / (1.0f + q * q);
}

// Shadow rays follow no chain of more interfaces than this. Light at the end of a longer one is left to the directions
// that BSDFs sample: it then has their weight alone (Chain::weight).
constexpr int longest_chain = 128;

constexpr float infinity = std::numeric_limits<float>::infinity();

// Rays travel in clear phases only.
const Clear& clear_at(const Scene& scene, Phase phase) {
    return std::get<Clear>(scene.materials[phase.index]);
}

// Whether a surface is a link of a chain: smooth, and clear on both sides. A mirror is none: shadow rays end there.
bool is_link(const Bsdf& bsdf, const Surface& surface) {
    return bsdf.is_delta() && surface.far_side;
}

// The ray on which a sampled direction goes on.
Ray continued(const Surface& surface, const Frame& frame, const BsdfSample& sample) {
    const glm::vec3 direction = glm::normalize(frame.to_world(sample.wi));
    return sample.transmitted ? surface.transmitted(direction) : surface.reflected(direction);
}

// What a shadow ray finds: the radiance that arrives, and of which emission, in which direction in the end, it is.
struct Arrival {
    glm::vec3 radiance;
    Lights::Emission emission;
    glm::vec3 direction;
};

// One random sample of E (path.hpp) along a shadow ray: the emission at the end of a chain of smooth clear interfaces,
// each of which reflects or refracts the ray at random, times the transmittance of the media and the weights of the
// interfaces; none if there is no light. Up to its first interface the ray goes straight to the light that was sampled,
// which is known; after that it is asked what light it sees.
std::optional<Arrival> emission_through_chain(const World& world, const Scene& scene, Ray ray,
                                              const LightSample& sampled, Sampler& sampler, PathCounters& counters) {
    glm::vec3 throughput(1.0f);
    for (int length = 0, segment = 0;; ++segment) {
        const float far = segment == 0 ? sampled.distance : infinity;
        const Visibility met = world.geometry().visibility(ray, far, counters);
        const Surface* surface = std::get_if<Surface>(&met);
        const Blocked* blocked = std::get_if<Blocked>(&met);
        const bool escaped = !surface && !blocked;
        const float distance = surface ? surface->distance : blocked ? blocked->distance : infinity;
        const Medium& medium = clear_at(scene, ray.phase).interior;
        const auto light = segment > 0 ? scene.lights.seen(ray.origin, ray.direction, distance, false)
                           : escaped
                               ? std::optional(Lights::Emission{sampled.distance, sampled.radiance, sampled.source})
                               : std::nullopt;
        if (light)
            return Arrival{throughput * transmittance(medium, light->distance) * light->radiance, *light,
                           ray.direction};
        if (!surface) return std::nullopt;
        throughput *= transmittance(medium, distance);
        const Bsdf bsdf = surface->bsdf();
        if (bsdf.passes_through()) {
            ray = surface->transmitted(ray.direction);
            continue;
        }
        if (!is_link(bsdf, *surface) || ++length > longest_chain) return std::nullopt;
        const Frame frame(surface->normal);
        const auto next = bsdf.sample(frame.to_local(-ray.direction), sampler.next(), glm::vec2(0.0f));
        if (!next) return std::nullopt;
        throughput *= next->weight;
        ray = continued(*surface, frame, *next);
    }
}

// What a path remembers of the last place where light was sampled. The weight of emission that it finds at the end of a
// chain depends on it.
struct Chain {
    // Of the BSDF, for the direction with which the chain began; none if lights were not sampled there.
    std::optional<float> pdf;
    LightProposal proposal{};
    glm::vec3 direction{0};
    int length = 0;

    float weight(const Lights& lights) const {
        if (!pdf || length > longest_chain) return 1;
        return power_heuristic(*pdf, proposal.pdf(lights, direction));
    }
};

// One path, and what it needs at every step.
class Path {
  public:
    Path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
         PathRecord* record)
        : world_(world),
          scene_(scene),
          sampler_(sampler),
          counters_(counters),
          ray_(ray),
          camera_ior_(clear_at(scene, ray.phase).ior),
          recorder_(record, scene) {}

    glm::vec3 trace() {
        for (int depth = 0; depth < scene_.settings.max_depth;) {
            const Hit hit = world_.geometry().intersect(ray_, counters_);
            const Surface* surface = std::get_if<Surface>(&hit);
            const float distance = surface ? surface->distance : infinity;
            if (add_emission(distance) || !surface) break;
            throughput_ *= transmittance(clear_at(scene_, ray_.phase).interior, distance);
            recorder_.travelled(ray_.phase, distance);
            ++depth;
            const Bsdf bsdf = surface->bsdf();
            if (bsdf.passes_through()) {  // equal indices scatter nothing, but do count for max_depth
                ray_ = surface->transmitted(ray_.direction);
                continue;
            }
            if (!scatter_and_continue(*surface, bsdf) || !roulette(depth)) break;
        }
        recorder_.finish(radiance_);
        return radiance_;
    }

  private:
    // Adds the emission of the light that the ray meets before the distance. Whether there is one: the path then ends.
    bool add_emission(float distance) {
        const auto light = scene_.lights.seen(ray_.origin, ray_.direction, distance, is_camera_ray_);
        if (!light) return false;
        const Medium& medium = clear_at(scene_, ray_.phase).interior;
        add_light(throughput_ * chain_.weight(scene_.lights) * transmittance(medium, light->distance) * light->radiance,
                  *light, ray_.direction, false);
        return true;
    }

    // Adds to the path's radiance, of an emission that was seen in the direction.
    void add_light(const glm::vec3& radiance, const Lights::Emission& emission, const glm::vec3& direction,
                   bool by_shadow_ray) {
        radiance_ += radiance;
        recorder_.add_light(radiance, emission, direction, by_shadow_ray);
    }

    // Tells the recorder of a surface before the path's ray leaves it.
    void record(const Surface& surface, const Bsdf& bsdf, const std::optional<BsdfSample>& next) {
        if (!recorder_.is_asked()) return;
        const auto ior = [&](Phase phase) { return clear_at(scene_, phase).ior; };
        const Phase after = next && next->transmitted ? surface.far_side->phase : ray_.phase;
        const glm::vec3 weight = next ? next->weight : glm::vec3(0.0f);
        const float bent = ior(after) / ior(ray_.phase), from_camera = ior(after) / camera_ior_;
        recorder_.scattered(surface, bsdf.is_delta(), is_link(bsdf, surface), weight * (bent * bent),
                            throughput_ * weight * (from_camera * from_camera));
    }

    // Adds direct light, and samples the path's next ray. Whether there is one.
    bool scatter_and_continue(const Surface& surface, const Bsdf& bsdf) {
        ++counters_.interactions;
        is_camera_ray_ = false;
        const Frame frame(surface.normal);
        const glm::vec3 wo = frame.to_local(-ray_.direction);
        LightProposal proposal(surface.near_side.origin, surface.normal, 1);
        if (!bsdf.is_delta()) {
            if (!surface.far_side) proposal = LightProposal::at(surface, world_, scene_, counters_);
            add_direct_light(surface, bsdf, frame, wo, proposal);
        }
        const float lobe = sampler_.next();
        const auto next = bsdf.sample(wo, lobe, sampler_.next2());
        record(surface, bsdf, next);
        if (!next) return false;
        throughput_ *= next->weight;
        ray_ = continued(surface, frame, *next);
        if (!next->delta)
            chain_ = {next->pdf, proposal, ray_.direction, 0};
        else if (is_link(bsdf, surface))
            ++chain_.length;
        else
            chain_ = {};  // a delta lobe that shadow rays cannot follow: that of a mirror or of a smooth coat
        return true;
    }

    // Next-event estimation: what arrives from the lights by a shadow ray, and is scattered into the path.
    void add_direct_light(const Surface& surface, const Bsdf& bsdf, const Frame& frame, const glm::vec3& wo,
                          const LightProposal& proposal) {
        const auto light = proposal.sample(scene_.lights, sampler_.next2());
        if (!light) return;
        const glm::vec3 wi = frame.to_local(light->wi);
        const glm::vec3 f = bsdf.evaluate(wo, wi);
        if (f == glm::vec3(0.0f)) return;
        const Ray shadow = wi.z < 0 ? surface.transmitted(light->wi) : surface.reflected(light->wi);
        const auto arrival = emission_through_chain(world_, scene_, shadow, *light, sampler_, counters_);
        if (!arrival) return;
        add_light(throughput_ * f * arrival->radiance * (power_heuristic(light->pdf, bsdf.pdf(wo, wi)) / light->pdf),
                  arrival->emission, arrival->direction, true);
    }

    // Russian roulette on what the path can still bring to the camera: radiance over η² is what refraction preserves.
    // Whether the path goes on.
    bool roulette(int depth) {
        const float ior = clear_at(scene_, ray_.phase).ior / camera_ior_;
        const float worth = std::max({throughput_.x, throughput_.y, throughput_.z}) * ior * ior;
        if (!(worth > 0)) return false;
        if (depth > 3 && worth < 0.95f) {
            const float survival = std::max(worth, 0.05f);
            if (sampler_.next() >= survival) return false;
            throughput_ /= survival;
        }
        return true;
    }

    const World& world_;
    const Scene& scene_;
    Sampler& sampler_;
    PathCounters& counters_;
    Ray ray_;
    float camera_ior_;
    glm::vec3 radiance_{0.0f}, throughput_{1.0f};
    Chain chain_;
    bool is_camera_ray_ = true;
    PathRecorder recorder_;
};

}  // namespace

glm::vec3 trace_path(const World& world, const Scene& scene, const Ray& ray, Sampler& sampler, PathCounters& counters,
                     PathRecord* record) {
    ++counters.paths;
    if (!is_clear(scene.materials[ray.phase.index])) {
        PathRecorder(record, scene).finish(glm::vec3(0.0f));
        return glm::vec3(0.0f);
    }
    return Path(world, scene, ray, sampler, counters, record).trace();
}

}  // namespace phasetree::tracer
