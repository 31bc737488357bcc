#include "integrator/interface_choice.hpp"

#include <algorithm>
#include <cmath>

#include "image/luminance.hpp"
#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// The brightness of the lights that a path would see after continuing with `next` and leaving into vacuum, where the
// lights are, through a plane parallel to the interface. For spectral paths the refractive index is that of the d line,
// so a small lamp may be looked for slightly off its apparent position. That adds noise but no bias.
float brightness(const Scene& scene, const Surface& surface, const Frame& frame, const BsdfSample& next) {
    const Phase phase = next.transmitted ? surface.far_side->phase : surface.near_side.phase;
    const float ior = clear_at(scene, phase).ior;
    const float x = ior * next.wi.x, y = ior * next.wi.y;
    const float cosine_squared = 1.0f - x * x - y * y;
    if (!(cosine_squared > 0.0f)) return 0.0f;  // total internal reflection at that plane
    const glm::vec3 outside(x, y, std::copysign(std::sqrt(cosine_squared), next.wi.z));
    const glm::vec3 direction = frame.to_world(outside);
    const auto light = scene.lights.seen(surface.near_side.origin, direction, Bounds::infinity, false);
    return std::max(light ? luminance(light->radiance) : 0.0f,
                    scene.lights.emissive_luminance(surface.near_side.origin, direction));
}

}  // namespace

InterfaceChoice chosen_by_lights(const Scene& scene, const Surface& surface, const Bsdf& bsdf, const Frame& frame,
                                 const glm::vec3& wo, float u) {
    const InterfaceChoice by_fresnel{u, 1.0f};
    const auto reflected = bsdf.sample(wo, 0.0f, {}), refracted = bsdf.sample(wo, one_minus_epsilon, {});
    if (!reflected || !refracted || reflected->transmitted || !refracted->transmitted) return by_fresnel;
    const float f = reflected->pdf;
    const float from_reflection = f * brightness(scene, surface, frame, *reflected);
    const float from_refraction = (1.0f - f) * brightness(scene, surface, frame, *refracted);
    const float from_both = from_reflection + from_refraction;
    if (!(from_both > 0.0f && from_both < Bounds::infinity)) return by_fresnel;
    const float q = 0.5f * (f + from_reflection / from_both);
    if (u < q) return {std::min(u / q * f, std::nextafter(f, 0.0f)), q / f};
    const float rest = (u - q) / (1.0f - q);
    // 1 − q is computed without the rounding of q, so that the quotient stays at least a half even where F is nearly 1.
    const float one_minus_q = 0.5f * ((1.0f - f) + from_refraction / from_both);
    return {std::min(f + rest * (1.0f - f), one_minus_epsilon), one_minus_q / (1.0f - f)};
}

}  // namespace phasetree::tracer
