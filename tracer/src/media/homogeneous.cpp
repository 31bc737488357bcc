#include "media/homogeneous.hpp"

#include <cmath>

#include "media/absorbing.hpp"
#include "media/channel_choice.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

// ∫₀ᵈ ε T dt = ε (1 − exp(−σ d))/σ with the extinction σ, computed precisely for small σ d, too. For σ = 0 it is ε d;
// on an infinite segment, which only unbounded phases have, it is omitted then.
glm::vec3 emitted_along(const ScatteringCoefficients::ForLight& coefficients, float length) {
    const glm::vec3 extinction = coefficients.extinction();
    glm::vec3 emitted(0.0f);
    if (coefficients.emission == glm::vec3(0.0f)) return emitted;
    for (int c = 0; c < 3; ++c)
        if (extinction[c] > 0.0f)
            emitted[c] = coefficients.emission[c] * -portable::expm1(-extinction[c] * length) / extinction[c];
        else if (std::isfinite(length))
            emitted[c] = coefficients.emission[c] * length;
    return emitted;
}

}  // namespace

glm::vec3 HomogeneousMedium::transmittance(const Way& way, Sampler&) const {
    return beer_lambert(coefficients_.for_light(way.wavelengths).extinction(), way.length);
}

Passage HomogeneousMedium::pass(const Way& way, Sampler& sampler) const {
    const glm::vec3 left = transmittance(way, sampler);
    return {left, emitted_along(coefficients_.for_light(way.wavelengths), way.length)};
}

Flight HomogeneousMedium::fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    const glm::vec3 extinction = coefficients.extinction();
    const glm::vec3 passed = beer_lambert(extinction, way.length);
    Flight flight;
    flight.emitted = emitted_along(coefficients, way.length);
    if (!coefficients.scatters()) {
        flight.weight = passed;
        return flight;
    }
    const glm::vec3 choice = channel_choice(throughput);
    const glm::vec2 u = sampler.next2();
    const float chosen = extinction[channel_at(choice, u.x)];
    // A distance of 0 would make the next ray start where this one did. u.y is in [0, 1), so 1 − u.y is never 0.
    const float distance = chosen > 0.0f ? -portable::log1p(-u.y) / chosen : way.length;
    if (distance < way.length) {
        const glm::vec3 left = beer_lambert(extinction, distance);
        flight.scattered_at = distance;
        flight.weight = coefficients.scattering * left / glm::dot(choice, extinction * left);
    } else {
        flight.weight = passed / glm::dot(choice, passed);
    }
    return flight;
}

}  // namespace phasetree::tracer
