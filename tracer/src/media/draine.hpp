// Draine's phase function. With the cosine μ,
//     p(μ) = 1/(4π) (1 − g²)/(1 + g² − 2gμ)^(3/2) (1 + α μ²)/(1 + α (1 + 2g²)/3).
// With α = 0 it is Henyey and Greenstein's; with g = 0 and α = 1, Rayleigh's. Its mean cosine is
//     g (1 + α (3 + 2g²)/5)/(1 + α (1 + 2g²)/3).
// With s² = 1 + g² − 2gμ, the probability of a larger cosine is
//     (1 − g²)/(2g (1 + α (1 + 2g²)/3)) (P(s) − P(1 − g)),
//     P(s) = −1/s + α/(4g²) (−(1 + g²)²/s − 2 (1 + g²) s + s³/3).
// sample() inverts it by Newton's method in double precision.
//
// References: Draine, Scattering by Interstellar Dust Grains. I. Optical and Ultraviolet, The Astrophysical Journal
// 598, 2003; Jendersie & d'Eon, An Approximate Mie Scattering Function for Fog and Cloud Rendering, SIGGRAPH 2023
// talks.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

class Draine {
  public:
    /// `g` is in (−1, 1), and `alpha` at least 0. A |g| below 0.001 counts as 0.
    Draine(float g, float alpha);

    float mean_cosine() const;
    float evaluate(float cosine) const;
    glm::vec3 sample(const glm::vec2& u) const;

  private:
    double below_pole(double u) const;

    float g_, alpha_;
    double norm_;  ///< 1 + α (1 + 2g²)/3
};

}  // namespace phasetree::tracer
