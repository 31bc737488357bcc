// A clear atmosphere over a spherical Earth: the radiance of the sky, and the transmittance towards the sun.
//
// Along a ray of length D through air that absorbs and scatters with σₜ,
//     L = ∫₀ᴰ T(0,t) Σ σₛ(t) [ p(cos γ) T_sun(t) E + Ψ(t) ] dt,   T(a,b) = exp(−∫ₐᵇ σₜ),
// summed over air molecules (Rayleigh's phase function) and aerosol (Cornette and Shanks'). Ψ represents all scattering
// after the first, assumed isotropic. With L₂ the radiance scattered twice, and f the share of light scattered once
// more, both averaged over directions, it is the geometric series Ψ = L₂/(1 − f).
//
// References:
//   - Hillaire: A Scalable and Production Ready Sky and Atmosphere Rendering Technique, EGSR 2020 (the model, Ψ);
//   - Bruneton, Neyret: Precomputed Atmospheric Scattering, EGSR 2008 (parametrisation of the transmittance table);
//   - Bruneton: A Qualitative and Quantitative Evaluation of 8 Clear Sky Models, TVCG 2017 (air and ozone at 680, 550
//     and 440 nm, which represent red, green and blue);
//   - Preetham, Shirley, Smits: A Practical Analytic Model for Daylight, 1999, appendix 1 (from turbidity to the
//     optical depth of the aerosol, Ångström's formula).
//
// Lengths are in kilometres. Radiances are per unit of the sun's irradiance E above the atmosphere, in all three
// channels: the sun counts as white there.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace phasetree::tracer {

class Atmosphere {
  public:
    /// Turbidity: 2 is very clear, 3 clear, 6 hazy, 10 thick haze; 1 is air without aerosol. The ground is diffuse.
    Atmosphere(double turbidity, const glm::dvec3& ground_albedo);

    /// A segment of a ray from an observer near the ground. `air` and `aerosol` are what it scatters into the ray, per
    /// light that arrives there, including the transmittance to the observer.
    struct Step {
        double distance;
        double radius;  ///< from the Earth's centre
        glm::dvec3 air;
        glm::dvec3 aerosol;
    };

    /// The ray at the given sine of its elevation, which must not be negative. It is the same for all azimuths.
    std::vector<Step> path(double sin_elevation) const;

    /// The radiance of the sky along a path. `view` and `to_sun` are unit vectors, z up.
    glm::dvec3 sky(std::span<const Step> path, const glm::dvec3& view, const glm::dvec3& to_sun) const;

    /// The share of sunlight that reaches the observer when the sun is at the given sine of its elevation.
    glm::dvec3 sun_transmittance(double sin_elevation) const;

  private:
    struct Medium {
        glm::dvec3 air;         ///< scattering by molecules
        glm::dvec3 aerosol;     ///< scattering by aerosol
        glm::dvec3 extinction;  ///< all scattering and absorption
    };
    struct Scattered {
        glm::dvec3 radiance;
        glm::dvec3 again;  ///< share of light scattered once along the ray
    };

    Medium medium(double radius) const;
    glm::dvec3 transmittance(double radius, double cosine) const;
    glm::dvec3 sunlight(double radius, double cosine) const;
    glm::dvec3 multiple(double radius, double sun_cosine) const;
    Scattered scattered_once_isotropically(double radius, const glm::dvec3& view, const glm::dvec3& to_sun) const;
    void tabulate_transmittance();
    void tabulate_multiple();

    glm::dvec3 aerosol_scattering_;
    glm::dvec3 aerosol_extinction_;
    glm::dvec3 ground_albedo_;
    std::vector<glm::dvec3> transmittance_;
    std::vector<glm::dvec3> multiple_;
};

}  // namespace phasetree::tracer
