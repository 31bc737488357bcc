#include "shading/texture/wood.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "phasetree/math/portable.hpp"
#include "phasetree/math/unit_vector.hpp"
#include "sampling/hash.hpp"
#include "shading/frame.hpp"
#include "shading/texture/noise.hpp"

namespace phasetree::tracer {

glm::vec3 WoodTexture::at(const glm::vec3& position) const {
    const glm::vec3 along = unit_vector(axis);
    const Frame trunk(along != glm::vec3(0.0f) ? along : glm::vec3{0.0f, 0.0f, 1.0f});
    // Unit: one ring. z is along the trunk.
    const glm::vec3 p = trunk.to_local(position - pith) / ring_spacing;

    // Radius in rings, with the trunk's slow wandering, its dents, and the small unevenness of each ring.
    const float wander_x = 1.2f * gradient_noise({0.03f * p.z, 0.5f, 0.5f}, hash(seed, 1u));
    const float wander_y = 1.2f * gradient_noise({0.03f * p.z, 0.5f, 0.5f}, hash(seed, 2u));
    const float radius = portable::hypot(p.x + wander_x, p.y + wander_y);
    const float dents = 0.9f * fractal_noise({0.17f * p.x, 0.17f * p.y, 0.03f * p.z}, 2, hash(seed, 3u));
    const float unevenness = 0.05f * gradient_noise({1.3f * p.x, 1.3f * p.y, 0.1f * p.z}, hash(seed, 4u));
    const float width = 1.1f * gradient_noise({0.31f * radius, 0.5f, 0.5f}, hash(seed, 5u));
    const float rings = radius + dents + unevenness + width;

    if (!(std::abs(rings) < 1e9f)) return light;  // beyond the resolution of floats

    const float year = std::floor(rings);
    const float season = rings - year;  // 0 spring, 1 the end of autumn
    const std::uint32_t year_hash = hash(seed, 6u, static_cast<std::uint32_t>(static_cast<std::int32_t>(year)));
    const float strength = 0.55f + 0.45f * hash_to_unit(year_hash);
    const float onset = 0.3f + 0.25f * hash_to_unit(hash(year_hash, 1u));
    // Slow transition into late wood, sharp transition out of it. Both ends are 0, so that years of different strength
    // join.
    const float growth = glm::smoothstep(onset, 0.93f, season);
    const float late = strength * growth * (1.0f - glm::smoothstep(0.955f, 1.0f, season));

    // Fibres: fine across the grain, thirty times as long along it.
    const float fibre = fractal_noise({11.0f * p.x, 11.0f * p.y, 0.35f * p.z}, 3, hash(seed, 7u));
    const float strand = gradient_noise({3.1f * p.x, 3.1f * p.y, 0.08f * p.z}, hash(seed, 8u));
    // Pores: cut vessels, dark, thin and short; denser in early wood.
    const float vessel = gradient_noise({17.0f * p.x, 17.0f * p.y, 0.6f * p.z}, hash(seed, 9u));
    const float pore = glm::smoothstep(0.34f, 0.5f, vessel) * glm::mix(1.0f, 0.35f, growth);
    // Broad streaks of darker heartwood.
    const float streak = fractal_noise({0.45f * p.x, 0.45f * p.y, 0.02f * p.z}, 2, hash(seed, 10u));

    const float tone = std::clamp(0.12f + 0.68f * late + 0.22f * fibre + 0.16f * strand + 0.24f * streak, 0.0f, 1.0f);
    const glm::vec3 body = glm::mix(light, dark, tone) * (1.0f + 0.14f * fibre);
    return glm::clamp(body * (1.0f - 0.55f * pore), 0.0f, 1.0f);
}

}  // namespace phasetree::tracer
