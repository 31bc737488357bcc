// The direction of travel after scattering, from its cosine and azimuth.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

/// `below_pole` is 1 − cosine, which stays precise for strong forward scattering; `turn` in [0, 1) is the azimuth.
inline glm::vec3 scattered_direction(float below_pole, float turn) {
    const float height = std::clamp(below_pole, 0.0f, 2.0f);
    const float sine = std::sqrt(height * (2.0f - height));
    const float phi = 2.0f * pi * turn;
    return {sine * std::cos(phi), sine * std::sin(phi), 1.0f - height};
}

}  // namespace phasetree::tracer
