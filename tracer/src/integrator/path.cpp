#include "integrator/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shading/beer_lambert.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

float power_heuristic(float a, float b) {
    // By the quotient, whose square cannot overflow where a² could.
    const float q = b / a;
    return 1.0f / (1.0f + q * q);
}

}  // namespace

glm::vec3 trace_path(const World& world, const Scene& scene, CameraRay ray, Phase phase, Sampler& sampler,
                     PathCounters& counters) {
    ++counters.paths;
    const auto medium = [&](Phase p) { return std::get_if<Clear>(&scene.materials[p.index]); };
    if (!medium(phase)) return glm::vec3(0.0f);
    const float camera_ior = medium(phase)->ior;

    glm::vec3 radiance(0.0f), throughput(1.0f);
    // The last place where light was sampled as well, and with which density the path left it; none after the camera or
    // a smooth interface.
    std::optional<float> pdf;
    glm::vec3 sampled_from = ray.origin;
    bool camera_ray = true;

    for (int depth = 0; depth < scene.settings.max_depth;) {
        const std::optional<Surface> surface = world.intersect(ray.origin, ray.direction, phase, counters.trace);
        const float distance = surface ? surface->distance : std::numeric_limits<float>::infinity();
        const glm::vec3& absorption = medium(phase)->absorption;

        const auto add = [&](const Lights::Emission& light) {
            const float weight = pdf ? power_heuristic(*pdf, scene.lights.pdf(sampled_from, ray.direction)) : 1.0f;
            radiance += throughput * weight * transmittance(absorption, light.distance) * light.radiance;
        };
        if (const auto lamp = scene.lights.intersect(ray.origin, ray.direction, distance, camera_ray)) {
            add(*lamp);
            break;
        }
        if (!surface) {
            add(scene.lights.infinite(ray.origin, ray.direction, camera_ray));
            break;
        }
        throughput *= transmittance(absorption, distance);

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
        if (!bsdf.is_delta()) {
            const float choice = sampler.next();
            if (const auto light = scene.lights.sample(surface->near_origin, choice, sampler.next2())) {
                const glm::vec3 wi = frame.to_local(light->wi);
                const glm::vec3 f = bsdf.evaluate(wo, wi);
                if (f != glm::vec3(0.0f)) {
                    const bool through = wi.z < 0;
                    const glm::vec3 passed = world.visibility(
                        through ? surface->far_origin : surface->near_origin, light->wi, light->distance,
                        through ? surface->far_phase : surface->near_phase, counters.trace);
                    radiance += throughput * passed * f * light->radiance *
                                (power_heuristic(light->pdf, bsdf.pdf(wo, wi)) / light->pdf);
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
        pdf = next->delta ? std::nullopt : std::optional<float>(next->pdf);
        sampled_from = surface->near_origin;
        if (!medium(phase)) break;

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
