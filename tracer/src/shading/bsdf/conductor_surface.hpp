// The properties that are constant over a metal's surface, smooth or rough, with a thin film or without: its
// reflectance and, for a rough surface, the energy that its BSDF must restore for multiple scattering
// (lost_energy.hpp).
//
// A real metal reflects the following fraction of the light that a lossless metal of the same roughness scatters more
// than once:
//     c = F̄² q / (1 − F̄ (1 − q)),   q = 1 / (1 + α/2 + α²/5),
// the sum over the second, third … scattering. Each multiplies the light by F̄, Fresnel's reflectance under uniform
// light, and the part q of the light then leaves the surface. So the colour of a rough metal is more saturated than
// that of a polished one. q was fitted to random walks on the microsurface: light that meets the surface again leaves
// more readily than light from outside, of which the part 1 − L̄ does. For brushed metal, α is the geometric mean of
// the roughnesses along its strokes and across; walks on such a microsurface agree with it.
//
// For spectral light, the index is that of the metal's spectrum, stored every few nanometres. The effect of a film on
// F̄ of a rough metal is taken from its colours.
//
// A metal may have a reflectance at normal incidence instead of an index, which may vary over the surface. Its index at
// each wavelength is then 1 + ik, with k² = 4 r / (1 − r), which has that reflectance against vacuum. F̄ is tabulated
// by r.
//
// A metal may also be described by two colours at each point (shading/f82.hpp). Its reflectance is then that, whatever
// the medium in front.
//
// Reference: Pharr, Jakob & Humphreys, Physically Based Rendering, 4th edition, 11.4 (k from a reflectance); Kulla &
// Conty 2017 (lost_energy.hpp), and for the square of F̄ Hill, A Multi-Faceted Exploration, 2018.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sampling/ggx.hpp"
#include "shading/bsdf/film_of_surface.hpp"
#include "shading/bsdf/lost_energy.hpp"
#include "shading/f82.hpp"
#include "shading/metals.hpp"
#include "shading/thin_film.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class ConductorSurface {
  public:
    /// The index η + ik is relative to vacuum, and so is `ior` of the clear medium in front. `roughness` is the α of
    /// GGX, for a surface that is rough somewhere. With a grain (shading/grain.hpp), it is the roughness across the
    /// strokes, and along them it is `aspect` times that. `spectrum` is the same index by wavelength, if known. Without
    /// it, the indices of blue, green and red are assumed to be those at 450, 550 and 650 nm, with linear
    /// interpolation.
    ConductorSurface(float ior, const glm::vec3& eta, const glm::vec3& k,
                     const std::optional<ValueRange>& roughness = {}, const std::optional<FilmOfSurface>& film = {},
                     std::span<const MetalPoint> spectrum = {}, float aspect = 1.0f,
                     std::shared_ptr<const LossTables> losses = {});

    /// A metal specified by a reflectance at each point; without a film.
    static ConductorSurface of_reflectance(float ior, const std::optional<ValueRange>& roughness = {},
                                           float aspect = 1.0f, std::shared_ptr<const LossTables> losses = {});

    /// The loss tables of a metal's microfacets, which surfaces of different metals may share. A surface without given
    /// tables makes its own.
    static std::shared_ptr<const LossTables> losses_of(const ValueRange& roughness, float aspect);

    /// The microfacets at a point with that roughness; local x is along the grain.
    Ggx microfacets(float roughness) const { return microfacets(roughness, aspect_); }
    static Ggx microfacets(float roughness, float aspect);

    /// The properties of a metal at a point. `reflectance` is set for a metal specified by it, and is in the components
    /// of `wavelengths`, if any.
    struct Place {
        float thickness = 0.0f;  ///< of the film, in nanometres
        const Wavelengths* wavelengths = nullptr;
        std::optional<glm::vec3> reflectance{};
        std::optional<F82Metal> by_colours{};  ///< replaces the index and the reflectance
    };
    /// For spectral light, or for red, green and blue.
    glm::vec3 fresnel(float cos_theta, const Place& place) const;

    /// The multiple-scattering lobe at a point with that roughness: the losses of single scattering, and the part of
    /// them that this metal reflects.
    struct Multiple {
        LossTables::At losses;
        glm::vec3 reflected;
    };
    Multiple multiple(float roughness, const Place& place) const;

  private:
    // The index relative to the medium in front, and F̄ without a film, at a wavelength.
    struct AtWavelength {
        float eta, k, mean_reflectance;
    };
    AtWavelength at(float nanometres) const;
    bool has_spectrum_for(const Wavelengths* wavelengths) const { return wavelengths && wavelengths->is_spectral; }

    // F̄ of a metal with that reflectance.
    float mean_of_reflectance(float reflectance) const;

    float ior_, aspect_;
    glm::vec3 eta_, k_;  ///< relative to the medium in front
    std::optional<ThinFilm> film_;
    std::shared_ptr<const LossTables> losses_;
    glm::vec3 mean_reflectance_{0.0f};      ///< F̄ without a film
    std::vector<AtWavelength> spectrum_;    ///< every few nanometres
    std::vector<float> mean_reflectances_;  ///< F̄ by reflectance from 0 to 1, for a rough metal specified by one
};

}  // namespace phasetree::tracer
