// The phase function of water droplets of one size, in fog and clouds: a mixture of Henyey and Greenstein's and
// Draine's, fitted to Mie's theory for white light and diameters d from 5 to 50 micrometres:
//     g = exp(−0.0990567/(d − 1.67154)),
//     g_D = exp(−2.20679/(d + 3.91029) − 0.428934),
//     α = exp(3.62489 − 8.29288/(d + 5.52825)),
//     share of Draine's: exp(−0.599085/(d − 0.641583) − 0.665888).
// Compared with a single lobe, it has a sharper peak forwards, and a little more light to the side and backwards. The
// fit has no glory and no fogbow.
//
// Reference: Jendersie & d'Eon, An Approximate Mie Scattering Function for Fog and Cloud Rendering, SIGGRAPH 2023
// talks.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "media/draine.hpp"
#include "media/mixture_of_two.hpp"

namespace phasetree::tracer {

class Droplets {
  public:
    static constexpr float least_diameter = 5.0f, greatest_diameter = 50.0f;  ///< in micrometres

    /// `diameter` is in micrometres, from the least to the greatest.
    explicit Droplets(float diameter)
        : forward_(std::exp(-0.0990567f / (diameter - 1.67154f)), 0.0f),
          wide_(std::exp(-2.20679f / (diameter + 3.91029f) - 0.428934f),
                std::exp(3.62489f - 8.29288f / (diameter + 5.52825f))),
          share_(std::exp(-0.599085f / (diameter - 0.641583f) - 0.665888f)) {}

    float mean_cosine() const { return mixed(share_, forward_.mean_cosine(), wide_.mean_cosine()); }
    float evaluate(float cosine) const { return mixed(share_, forward_.evaluate(cosine), wide_.evaluate(cosine)); }
    glm::vec3 sample(const glm::vec2& u) const { return sample_of_two(share_, u, forward_, wide_); }

  private:
    Draine forward_;  ///< Henyey and Greenstein's, in double precision: its peak is too narrow for floats
    Draine wide_;
    float share_;  ///< of the second
};

}  // namespace phasetree::tracer
