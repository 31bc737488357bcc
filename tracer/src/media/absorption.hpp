// This is how much of light a medium absorbs per unit of length.
//
// It is given for red, green and blue, as a colour that is left after a distance, or by wavelength. Light of
// wavelengths loses what makes the colour after that distance exactly what it is for red, green and blue: with the
// colour's spectrum c(λ) (for_light()) a(λ) = −ln c(λ)/d. Three coefficients alone say nothing of a distance, and a(λ)
// is their mixture, as is that of scattering.
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
    /// For red, green and blue, per unit of length; not negative.
    Absorption(const glm::vec3& rgb) : rgb_(rgb) {}  // NOLINT: it converts by itself
    explicit Absorption(float grey) : rgb_(grey) {}
    /// What is left of white light after a distance, in (0, 1].
    static Absorption left_after(const glm::vec3& colour, float distance) {
        Absorption absorption(glm::max(-glm::log(colour) / distance, glm::vec3(0.0f)));
        absorption.left_ = colour;
        absorption.distance_ = distance;
        return absorption;
    }
    /// By wavelength, per unit of length; not negative. For colours it is what makes their light the same after a
    /// distance of one over its mean, which lets a third of white light through, or more.
    static Absorption of(SharedSpectrum spectrum);

    /// The same of what is so many times as dense.
    Absorption times(float factor) const {
        Absorption scaled = *this;
        scaled.factor_ *= factor;
        return scaled;
    }

    glm::vec3 rgb() const { return factor_ * rgb_; }
    /// At least the greatest at any wavelength and for any of the colours, together with a scattering.
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
    float factor_ = 1.0f;    ///< of all the others
    SharedSpectrum spectrum_{};
};

}  // namespace phasetree::tracer
