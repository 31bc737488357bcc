#include "shading/texture/marble.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "sampling/hash.hpp"
#include "shading/texture/noise.hpp"

namespace phasetree::tracer {

glm::vec3 MarbleTexture::at(const glm::vec3& position) const {
    const glm::vec3 p = position / scale;
    const glm::vec3 warp{fractal_noise(p, 5, hash(seed, 1u)), fractal_noise(p, 5, hash(seed, 2u)),
                         fractal_noise(p, 5, hash(seed, 3u))};
    const glm::vec3 q = p + 0.6f * warp;
    // The width and strength of a vein vary along it.
    const float strength = glm::smoothstep(-0.35f, 0.55f, gradient_noise(0.7f * p, hash(seed, 4u)));
    const float distance = std::abs(gradient_noise(0.8f * q, hash(seed, 5u)));
    const float main_vein = strength * std::exp(-distance / (0.012f + 0.05f * strength));
    const float fine = std::abs(gradient_noise(2.3f * q, hash(seed, 6u)));
    const float fine_vein = 0.45f * strength * std::exp(-fine / 0.02f);
    const float cloud = 0.16f * glm::smoothstep(-0.6f, 0.9f, fractal_noise(0.9f * q, 4, hash(seed, 7u)));
    return glm::mix(color, vein, std::clamp(std::max(main_vein, fine_vein) + cloud, 0.0f, 1.0f));
}

}  // namespace phasetree::tracer
