// What is the same all over a metal's surface, smooth or rough, with a thin film or without: how much it reflects, and
// for a rough one the light that its BSDF has to give back after several scatterings (lost_energy.hpp).
//
// Of what a lossless metal of that roughness would give back after several scatterings, a real one gives
//     c = F̄² q / (1 − F̄ (1 − q)),   q = 1 / (1 + α/2 + α²/5),
// the sum over the second, third … scattering, of each of which F̄ is left, Fresnel's reflectance under uniform light,
// and the part q of the light gets away. So the colour of a rough metal is deeper than that of a polished one. We
// fitted q to walks on the microsurface: the light that meets the surface again gets away more readily than that which
// comes from outside, of which the part 1 − L̄ does. Of brushed metal α is here the geometric mean of the
// roughnesses along its strokes and across; walks on such a microsurface agree with it.
//
// At wavelengths the index is that of the metal's spectrum, which is kept every few nanometres. What a film on a rough
// metal makes of F̄ is taken from its colours there.
//
// A metal may have a reflectance at normal incidence instead of an index, another at each place: at each wavelength
// its index is 1 + ik then, with k² = 4 r / (1 − r), which has that reflectance against a vacuum. F̄ comes from a table
// over r.
//
// Reference: Pharr, Jakob & Humphreys, Physically Based Rendering, 4th edition, 11.4 (k from a reflectance);
// Kulla & Conty 2017 (lost_energy.hpp), and for the square of F̄ Hill, A Multi-Faceted Exploration, 2018.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sampling/ggx.hpp"
#include "shading/bsdf/film_of_surface.hpp"
#include "shading/bsdf/lost_energy.hpp"
#include "shading/metals.hpp"
#include "shading/thin_film.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class ConductorSurface {
  public:
    /// The index η + ik is that against vacuum, as is `ior` of the clear medium in front. `roughness` is that of GGX,
    /// for a surface that is rough somewhere; with a grain (shading/grain.hpp) it is the roughness across the strokes,
    /// and along them it is `aspect` times that.
    /// `spectrum` is the same index by wavelength, if it is known; without it that of blue, green and red is taken to
    /// be the index at 450, 550 and 650 nm, between which it is linear.
    ConductorSurface(float ior, const glm::vec3& eta, const glm::vec3& k,
                     const std::optional<ValueRange>& roughness = {}, const std::optional<FilmOfSurface>& film = {},
                     std::span<const MetalPoint> spectrum = {}, float aspect = 1.0f,
                     std::shared_ptr<const LossTables> losses = {});

    /// A metal that has a reflectance at each place; without a film.
    static ConductorSurface of_reflectance(float ior, const std::optional<ValueRange>& roughness = {},
                                           float aspect = 1.0f, std::shared_ptr<const LossTables> losses = {});

    /// What a metal's microfacets lose, which surfaces of different metals may share; a surface that is given none
    /// makes its own.
    static std::shared_ptr<const LossTables> losses_of(const ValueRange& roughness, float aspect);

    /// Its microfacets at a place of that roughness; local x is along the grain.
    Ggx microfacets(float roughness) const { return microfacets(roughness, aspect_); }

    /// What a metal is like at a place. `reflectance` is that of a metal that has one there, for the wavelengths if
    /// there are some.
    struct Place {
        float thickness = 0.0f;  ///< of the film, in nanometres
        const Wavelengths* wavelengths = nullptr;
        std::optional<glm::vec3> reflectance{};
    };
    /// For light of wavelengths, or for red, green and blue.
    glm::vec3 fresnel(float cos_theta, const Place& place) const;

    /// Of the lobe after several scatterings at a place of that roughness: what single scattering loses, and the part
    /// of it that this metal gives back.
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

    static Ggx microfacets(float roughness, float aspect);
    // F̄ of a metal of that reflectance.
    float mean_of_reflectance(float reflectance) const;

    float ior_, aspect_;
    glm::vec3 eta_, k_;  ///< relative to the medium in front
    std::optional<ThinFilm> film_;
    std::shared_ptr<const LossTables> losses_;
    glm::vec3 mean_reflectance_{0.0f};      ///< F̄ without a film
    std::vector<AtWavelength> spectrum_;    ///< every few nanometres
    std::vector<float> mean_reflectances_;  ///< F̄ over the reflectance from 0 to 1, of a rough metal that has one
};

}  // namespace phasetree::tracer
