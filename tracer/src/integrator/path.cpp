#include "integrator/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/light_proposal.hpp"
#include "shading/beer_lambert.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

float power_heuristic(float a, float b) {
    // By the quotient, whose square cannot overflow where a² could.
    const float q = b / a;
    return 1.0f / (1.0f + q * q);
}

// A chain longer than this is not followed; paths know it too, so that its light is left to them alone.
constexpr int longest_chain = 128;

constexpr float infinity = std::numeric_limits<float>::infinity();

// Whether a surface is a link of a chain: smooth, and clear on both sides. A mirror is none: shadow rays end there.
bool links(const Scene& scene, const Bsdf& bsdf, const Surface& surface) {
    return bsdf.is_delta() && surface.near_phase != surface.far_phase &&
           is_clear(scene.materials[surface.far_phase.index]);
}

// E of path.hpp along a ray that was sampled: the emission at the end of one chain of smooth clear interfaces, times
// what the media and refraction leave of it.
glm::vec3 emission_through_chain(const World& world, const Scene& scene, CameraRay ray, const LightSample& sampled,
                                 Phase phase, Start start, Sampler& sampler, PathCounters& counters) {
    glm::vec3 throughput(1.0f);
    for (int length = 0, segment = 0;; ++segment) {
        const float far = segment == 0 ? sampled.distance : infinity;
        const std::optional<Surface> surface =
            world.intersect(ray.origin, ray.direction, far, phase, start, Purpose::light, counters);
        const float distance = surface ? surface->distance : infinity;
        const glm::vec3& absorption = std::get<Clear>(scene.materials[phase.index]).absorption;
        const auto light = segment > 0 ? scene.lights.seen(ray.origin, ray.direction, distance, false)
                           : surface   ? std::nullopt
                                       : std::optional(Lights::Emission{sampled.distance, sampled.radiance});
        if (light) return throughput * transmittance(absorption, light->distance) * light->radiance;
        if (!surface->optics) return glm::vec3(0.0f);  // opaque
        throughput *= transmittance(absorption, distance);
        start = surface->start;
        const Bsdf bsdf = surface->optics->at(surface->near_origin);
        if (bsdf.passes_through()) {
            ray.origin = surface->far_origin;
            phase = surface->far_phase;
            continue;
        }
        if (!links(scene, bsdf, *surface) || ++length > longest_chain) return glm::vec3(0.0f);
        const Frame frame(surface->normal);
        const auto next = bsdf.sample(frame.to_local(-ray.direction), sampler.next(), glm::vec2(0.0f));
        if (!next) return glm::vec3(0.0f);
        throughput *= next->weight;
        ray.direction = glm::normalize(frame.to_world(next->wi));
        ray.origin = next->transmitted ? surface->far_origin : surface->near_origin;
        phase = next->transmitted ? surface->far_phase : surface->near_phase;
    }
}

// What the last place where light was sampled leaves to its path: what the weight of emission found at the end of a
// chain depends on.
struct Chain {
    std::optional<float> pdf;  // of the BSDF, for the direction with which the chain began; none: no light was sampled
    LightProposal proposal{};
    glm::vec3 direction{0};
    int length = 0;

    float weight(const Lights& lights) const {
        if (!pdf || length > longest_chain) return 1;
        return power_heuristic(*pdf, proposal.pdf(lights, direction));
    }
};

}  // namespace

glm::vec3 trace_path(const World& world, const Scene& scene, CameraRay ray, Phase phase, Sampler& sampler,
                     PathCounters& counters) {
    ++counters.paths;
    const auto medium = [&](Phase p) { return std::get_if<Clear>(&scene.materials[p.index]); };
    if (!medium(phase)) return glm::vec3(0.0f);
    const float camera_ior = medium(phase)->ior;

    glm::vec3 radiance(0.0f), throughput(1.0f);
    Start start;
    Chain chain;
    bool camera_ray = true;

    for (int depth = 0; depth < scene.settings.max_depth;) {
        const std::optional<Surface> surface =
            world.intersect(ray.origin, ray.direction, infinity, phase, start, Purpose::path, counters);
        const float distance = surface ? surface->distance : infinity;
        const glm::vec3& absorption = medium(phase)->absorption;

        if (const auto light = scene.lights.seen(ray.origin, ray.direction, distance, camera_ray)) {
            radiance +=
                throughput * chain.weight(scene.lights) * transmittance(absorption, light->distance) * light->radiance;
            break;
        }
        throughput *= transmittance(absorption, distance);
        start = surface->start;

        const Bsdf bsdf = surface->optics->at(surface->near_origin);
        if (bsdf.passes_through()) {  // equal indices: no event at all
            ++depth;
            ray.origin = surface->far_origin;
            phase = surface->far_phase;
            continue;
        }
        ++depth;
        ++counters.interactions;
        camera_ray = false;

        const Frame frame(surface->normal);
        const glm::vec3 wo = frame.to_local(-ray.direction);
        LightProposal proposal(surface->near_origin, surface->normal, 1);
        if (!bsdf.is_delta()) {
            const bool is_clear_behind = surface->near_phase != surface->far_phase && medium(surface->far_phase);
            if (!is_clear_behind) proposal = LightProposal::at(*surface, world, scene, counters);
            if (const auto light = proposal.sample(scene.lights, sampler.next2())) {
                const glm::vec3 wi = frame.to_local(light->wi);
                const glm::vec3 f = bsdf.evaluate(wo, wi);
                if (f != glm::vec3(0.0f)) {
                    const bool through = wi.z < 0;
                    const CameraRay shadow{through ? surface->far_origin : surface->near_origin, light->wi};
                    const glm::vec3 arrives = emission_through_chain(world, scene, shadow, *light,
                                                                     through ? surface->far_phase : surface->near_phase,
                                                                     start, sampler, counters);
                    radiance += throughput * f * arrives * (power_heuristic(light->pdf, bsdf.pdf(wo, wi)) / light->pdf);
                }
            }
        }

        const float lobe = sampler.next();
        const auto next = bsdf.sample(wo, lobe, sampler.next2());
        if (!next) break;
        throughput *= next->weight;
        ray.direction = glm::normalize(frame.to_world(next->wi));
        ray.origin = next->transmitted ? surface->far_origin : surface->near_origin;
        phase = next->transmitted ? surface->far_phase : surface->near_phase;
        if (!medium(phase)) break;
        if (!next->delta)
            chain = {next->pdf, proposal, ray.direction, 0};
        else if (links(scene, bsdf, *surface))
            ++chain.length;
        else
            chain = {};  // a mirror: no light was sampled

        // Roulette on what the path can still bring to the camera: radiance over η² is what refraction preserves.
        const float ior = medium(phase)->ior / camera_ior;
        const float worth = std::max({throughput.x, throughput.y, throughput.z}) * ior * ior;
        if (!(worth > 0)) break;
        if (depth > 3 && worth < 0.95f) {
            const float survival = std::max(worth, 0.05f);
            if (sampler.next() >= survival) break;
            throughput /= survival;
        }
    }
    return radiance;
}

}  // namespace phasetree::tracer
