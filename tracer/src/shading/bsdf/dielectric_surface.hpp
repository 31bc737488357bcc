// The properties that are constant over an interface of two clear media, smooth or rough, with a thin film or without:
// its reflectance and, for a rough interface, the energy that its BSDF must restore for multiple scattering
// (lost_energy.hpp).
//
// A fraction t_ab of the light that is scattered several times on one side, a, leaves through the surface to the other
// side, b. Reciprocity requires t_ab/t_ba = n_b² L̄_b / (n_a² L̄_a), with L̄ the loss of lost_energy.hpp of each side.
// It leaves the sum t_ab + t_ba free. It is set to (1 − F̄_a) + (1 − F̄_b), with F̄ Fresnel's reflectance under uniform
// light, as if each further scattering transmitted that much: a model, not a derivation. Neither part exceeds 1. A
// random walk on the microsurface transmits more than this from outside (η = 1.5), by up to 7 % of the light, and up to
// 30 % more or less from inside where α is 1.
#pragma once

#include <memory>
#include <optional>

#include "shading/bsdf/film_of_surface.hpp"
#include "shading/bsdf/lost_energy.hpp"
#include "shading/bsdf/thin_films.hpp"
#include "shading/fresnel.hpp"
#include "shading/thin_film.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// (η_from/η_to)², the factor by which refraction changes radiance.
float radiance_factor(float ior_from, float ior_to);

class DielectricSurface {
  public:
    /// `roughness` is the α of GGX, for an interface that is rough somewhere. A film of varying thickness has the
    /// middle of its range everywhere on a rough interface, so that the tables are right.
    DielectricSurface(float ior_from, float ior_to, const std::optional<ValueRange>& roughness = {},
                      const std::optional<FilmOfSurface>& film = {});
    /// As above, with its film taken from `films`.
    DielectricSurface(float ior_from, float ior_to, const std::optional<ValueRange>& roughness,
                      const std::optional<FilmOfSurface>& film, ThinFilms& films);

    /// The same interface, met from the other side. It shares all tables.
    DielectricSurface reversed() const;

    float eta() const { return eta_; }  ///< η_to/η_from
    float radiance_factor() const { return radiance_factor_; }
    /// Equal indices without a film: light continues as if there were no interface.
    bool is_none() const { return eta_ == 1.0f && !film_; }
    bool has_film() const { return film_ != nullptr; }
    /// The thickness of the film where the interface is rough: the middle of its range.
    float middle_thickness() const { return middle_thickness_; }

    struct Fresnel {
        glm::vec3 reflectance;
        float cos_transmitted;
    };
    /// For red, green and blue.
    Fresnel fresnel(float cos_theta, float thickness) const;
    /// For spectral light, or for colours if `wavelengths` is null. A film reflects the exact amount at each
    /// wavelength.
    Fresnel fresnel(float cos_theta, float thickness, const Wavelengths* wavelengths) const;

    /// The multiple-scattering lobes at a point with that roughness.
    struct Multiple {
        LossTables::At from, to;     ///< on the side of wo, and on the other side
        glm::vec3 transmitted;       ///< t_ab
        glm::vec3 transmitted_back;  ///< t_ba
    };
    Multiple multiple(float roughness) const;

  private:
    struct Side {
        LossTables losses;
        glm::vec3 mean_reflectance;  ///< F̄
    };

    Side side(const ValueRange& roughness) const;

    float eta_;
    float radiance_factor_, radiance_factor_back_;
    float middle_thickness_;
    std::shared_ptr<const ThinFilm> film_;  ///< seen from the medium with the lower index
    std::shared_ptr<const Side> from_, to_;
};

}  // namespace phasetree::tracer
