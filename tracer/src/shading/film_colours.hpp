// The colours of a thin film (thin_film.hpp) on metals whose index varies from point to point, so that the table of
// thin_film.hpp cannot be used.
//
// With x = −r₁₂ r₂₃, Airy's sum of each polarisation is a Fourier series in the phase δ = 2π D/λ, D = 2 d q₂:
//
//     R = 1 − (1 − r₁₂²)(1 − |r₂₃|²)/(1 − |x|²) · (1 + 2 Σₘ Re(xᵐ e^{imδ}))
//
// so its colour needs only the Fourier transform W(D) of the weights of red, green and blue (colour_matching.hpp),
// which is tabulated: e^{imδ} becomes W(m D). W vanishes for large D, where light is no longer coherent.
//
// Reference: Belcour & Barla, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence,
// SIGGRAPH 2017, sections 3 and 4. They fit W by Gaussians.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace phasetree::tracer {

class FilmColours {
  public:
    FilmColours();

    /// R for red, green and blue of a film on metal with the index 1 + ik, which may differ by colour. `outside` and
    /// `film` are the indices of the medium outside and of the film; the thickness is in nanometres.
    glm::vec3 reflectance(float outside, float film, const glm::vec3& k, float cos_theta, float thickness) const;

  private:
    static constexpr float step = 5.0f, longest = 40000.0f;  ///< of D in nanometres

    // The real and the imaginary part of W.
    struct Transform {
        glm::vec3 real{0.0f}, imaginary{0.0f};
    };
    Transform at(float path) const;

    std::vector<Transform> table_;
};

}  // namespace phasetree::tracer
