// A film thinner than a few wavelengths of light on an interface: oil on water, a soap bubble, the oxide on a metal.
// The reflections of its two faces interfere, depending on the wavelength.
//
// With the indices n₁ outside, n₂ of the film and n₃ = η + ik behind it, qⱼ = √(nⱼ² − n₁² sin²θ) and the thickness d,
//
//     r = (r₁₂ + r₂₃ e^{iδ}) / (1 + r₁₂ r₂₃ e^{iδ}),   δ = 4π d q₂/λ                       (Airy's sum)
//     s: rⱼₖ = (qⱼ − qₖ)/(qⱼ + qₖ),   p: rⱼₖ = (nₖ² qⱼ − nⱼ² qₖ)/(nₖ² qⱼ + nⱼ² qₖ)
//     R = (|rₛ|² + |rₚ|²)/2, for each colour the mean of R(λ) by colour_matching.hpp
//
// A film does not absorb: 1 − R is transmitted. It is too thin to displace rays; refraction is the same as without it.
// Indices do not depend on the wavelength, except those of metals. Colours outside of the gamut are clipped to [0, 1].
//
// The colours of R are tabulated over cos θ in the medium outside and, if the thickness varies, over the thickness.
// Spectral light uses R(λ) itself.
//
// References: Born & Wolf, Principles of Optics, 7th ed., 1.6.4; Belcour & Barla, A Practical Extension to Microfacet
// Theory for the Modeling of Varying Iridescence, SIGGRAPH 2017 (why the spectrum must be integrated).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace phasetree::tracer {

class ThinFilm {
  public:
    /// Thicknesses are in nanometres.
    static constexpr float thickest = 5000.0f;

    struct Layers {
        float outside;           ///< index of the clear medium in which light arrives
        float film;              ///< of the film
        glm::vec3 eta, k{0.0f};  ///< of what is behind it, for red, green and blue
        bool operator==(const Layers&) const = default;
    };

    ThinFilm(const Layers& layers, float least_thickness, float greatest_thickness);

    /// R for light that arrives outside at an angle with that cosine.
    glm::vec3 reflectance(float cos_theta, float thickness) const;
    /// The exact R at three wavelengths in nanometres. `eta` and `k` are the indices behind the film at each of them.
    glm::vec3 reflectance_at(const glm::vec3& nanometres, const glm::vec3& eta, const glm::vec3& k, float cos_theta,
                             float thickness) const;
    /// As above, with the indices of `Layers`, which must be the same for all colours.
    glm::vec3 reflectance_at(const glm::vec3& nanometres, float cos_theta, float thickness) const {
        return reflectance_at(nanometres, layers_.eta, layers_.k, cos_theta, thickness);
    }
    /// 2 ∫ R μ dμ, the reflectance under uniform light from outside.
    glm::vec3 average(float thickness) const;

  private:
    static constexpr std::size_t cosines = 256;

    std::size_t row_of(float thickness, float& part) const;

    Layers layers_;
    float least_, step_ = 1.0f;
    std::vector<glm::vec3> table_;     ///< rows of `cosines` values from cos θ = 0 to 1, one per thickness
    std::vector<glm::vec3> averages_;  ///< one per thickness
};

/// The exact R of one wavelength in nanometres; `behind_eta` + i `behind_k` is n₃.
double thin_film_reflectance(double outside, double film, double behind_eta, double behind_k, double cos_theta,
                             double thickness, double wavelength);

}  // namespace phasetree::tracer
