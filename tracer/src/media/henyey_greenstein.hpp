// The phase function of Henyey and Greenstein. With μ the cosine between the directions of travel before and after,
//     p(μ) = (1 − g²) / (4π (1 + g² − 2gμ)^(3/2)),
// whose mean cosine is g. It integrates to 1 over all directions, and is sampled exactly by
//     μ = (1 + g² − s²)/(2g),   s = (1 − g²)/(1 − g + 2gu).
//
// Reference: Henyey & Greenstein, Diffuse Radiation in the Galaxy, Astrophysical Journal 93 (1941), 70-83.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "media/scattered_direction.hpp"
#include "sampling/warps.hpp"

namespace phasetree::tracer {

class HenyeyGreenstein {
  public:
    /// `g` is in (−1, 1); positive means forward scattering.
    explicit HenyeyGreenstein(float g = 0.0f) : g_(g) {}

    float g() const { return g_; }
    float mean_cosine() const { return g_; }

    /// Per steradian; also the pdf of sample().
    float evaluate(float cosine) const {
        const float squared =
            std::max(1.0f + g_ * g_ - 2.0f * g_ * cosine, (1.0f - std::abs(g_)) * (1.0f - std::abs(g_)));
        return (1.0f - g_ * g_) / (4.0f * pi * squared * std::sqrt(squared));
    }

    /// Samples the direction of travel after scattering, in a frame whose z is the direction before; u is in [0, 1)².
    glm::vec3 sample(const glm::vec2& u) const {
        // 1 − μ, which stays precise for strong forward scattering.
        const float s = (1.0f - g_ * g_) / (1.0f - g_ + 2.0f * g_ * (1.0f - u.x));
        const float below_pole = std::abs(g_) < 1e-3f ? 2.0f * u.x : (s * s - (1.0f - g_) * (1.0f - g_)) / (2.0f * g_);
        return scattered_direction(below_pole, u.y);
    }

  private:
    float g_;
};

}  // namespace phasetree::tracer
