// The absorption coefficient of a medium, per unit length.
//
// It is given for red, green and blue, as the colour that remains after a distance, or by wavelength. In the second
// case, spectral light is absorbed such that the colour after that distance equals the colour for red, green and blue:
// with the colour's spectrum c(λ) (for_light()), a(λ) = −ln c(λ)/d. If only three coefficients are given, there is no
// such distance. a(λ) is then their mixture, as for scattering.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "spectrum/spectrum.hpp"

namespace phasetree::tracer {

class Absorption {
  public:
    Absorption() = default;
    /// For red, green and blue, per unit length; not negative.
    Absorption(const glm::vec3& rgb) : rgb_(rgb) {}  // NOLINT: implicit conversion is intended
    explicit Absorption(float grey) : rgb_(grey) {}
    /// From the colour of white light after a distance, with components in (0, 1].
    static Absorption left_after(const glm::vec3& colour, float distance) {
        Absorption absorption(glm::max(-glm::log(colour) / distance, glm::vec3(0.0f)));
        absorption.left_ = colour;
        absorption.distance_ = distance;
        return absorption;
    }
    /// By wavelength, per unit length; not negative. The colour coefficients are chosen such that colours agree with it
    /// at a distance of one over its mean, where at least a third of white light is transmitted.
    static Absorption of(SharedSpectrum spectrum);

    /// The absorption of a medium with `factor` times the density.
    Absorption times(float factor) const {
        Absorption scaled = *this;
        scaled.factor_ *= factor;
        return scaled;
    }

    glm::vec3 rgb() const { return factor_ * rgb_; }
    /// An upper bound, over all wavelengths and all colours, on the sum of absorption and scattering.
    float greatest_with(const glm::vec3& scattering) const {
        const glm::vec3 sum = rgb() + scattering;
        const float colours = std::max({sum.x, sum.y, sum.z});
        if (!spectrum_) return colours;
        return std::max(colours,
                        factor_ * spectrum_->greatest() + std::max({scattering.x, scattering.y, scattering.z}));
    }
    glm::vec3 for_light(const Wavelengths* wavelengths) const {
        if (!wavelengths) return rgb();
        if (spectrum_ && wavelengths->is_spectral) return factor_ * spectrum_->at(*wavelengths);
        if (!(distance_ > 0.0f)) return tracer::for_light(rgb(), wavelengths);
        const glm::vec3 left = glm::min(tracer::for_light(left_, wavelengths), glm::vec3(1.0f));
        return factor_ * -glm::log(left) / distance_;
    }

  private:
    glm::vec3 rgb_{0.0f}, left_{1.0f};
    float distance_ = 0.0f;  ///< 0 if no colour was given
    float factor_ = 1.0f;    ///< of all other members
    SharedSpectrum spectrum_{};
};

}  // namespace phasetree::tracer
