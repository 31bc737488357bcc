// Closed forms for a pane: two parallel, smooth interfaces of the same index, with a coloured glass between them and
// the same medium on both sides. All reflections inside are summed. With Fresnel's reflectance r of one interface, and
// the share a of the light that crosses the glass once:
//     R = r + (1 − r)² r a² (1 + r² a² + r⁴ a⁴ + …) = r + (1 − r)² r a² / (1 − r² a²)
//     T = (1 − r)² a / (1 − r² a²)
// Without absorption, R + T = 1. A ray at the angle θ' inside crosses 1/cos θ' times the thickness, so a is the share
// at normal incidence to that power.
//
// Approximations: light is unpolarised at every interface, as everywhere in this program; the pane is so thin that
// light leaves it where it entered; and so thick that nothing interferes (for films, see thin_film.hpp). So it looks
// like a slab of a clear phase without the slab's parallel displacement of the light.
//
// Reference: Stokes, On the Intensity of the Light Reflected from or Transmitted through a Pile of Plates, Proceedings
// of the Royal Society 11, 1862; Pharr, Jakob & Humphreys, Physically Based Rendering, 4th edition, 9.5.1.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

class ThinPane {
  public:
    /// `eta` is the index of the pane over that of the medium around it. `colour` is the share of the light that
    /// crosses the glass once at normal incidence, without reflections.
    ThinPane(float eta, const glm::vec3& colour) : eta_(eta), colour_(colour) {}

    struct Shares {
        glm::vec3 reflected, transmitted;

        /// The probability with which light is reflected rather than transmitted, from the means of the channels; 0 if
        /// all light is absorbed.
        float choice_of_reflection() const;
    };
    /// `cos_theta` in [0, 1].
    Shares at(float cos_theta) const;
    /// The shares of uniform light from one side: 2 ∫ R μ dμ, and the same for T.
    Shares under_uniform_light() const;

    float eta() const { return eta_; }

  private:
    float eta_;
    glm::vec3 colour_;
};

}  // namespace phasetree::tracer
