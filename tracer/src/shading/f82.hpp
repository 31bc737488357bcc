// The reflectance of a metal described by two colours, OpenPBR's "F82-tint":
//
//   F(μ) = w (S(μ) − μ (1 − μ)⁶ a),   S(μ) = F₀ + (1 − F₀)(1 − μ)⁵,   a = (1 − t) S(μ₈₂) / (μ₈₂ (1 − μ₈₂)⁶)
//
// F₀ is the colour at normal incidence and t the tint of Schlick's curve S at μ₈₂ = 1/7, an angle of 82°, where the
// reflectance of real metals dips. Under uniform light, F̄ = w (F₀ + (1 − F₀)/21 − a/126). Dark colours with a strong
// tint would give a negative F, which is clamped to 0.
//
// With a thin film, F is mixed with that of the film on a metal of the index 1 + ik that has the reflectance F₀; the
// tint does not apply to that part. F̄ ignores the film.
//
// References: OpenPBR Surface 1.1, "Metal"; Kutz, Hašan & Edmondson, Novel Aspects of the Adobe Standard Material,
// 2021; Hoffman, Fresnel Equations Considered Harmful, MAM 2019.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/film_colours.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

struct F82Metal {
    struct Film {
        const FilmColours* colours;  ///< outlives the metal
        float outside, ior;          ///< indices of the medium outside and of the film
        float thickness;             ///< in nanometres
        float weight;                ///< share of the surface that it covers
    };

    glm::vec3 normal{0.8f};  ///< F₀
    glm::vec3 edge{1.0f};    ///< t
    float weight = 1.0f;     ///< w
    std::optional<Film> film{};

    /// F. The colours are in the components of `wavelengths`, or red, green and blue if it is null.
    glm::vec3 reflectance(float cos_theta, const Wavelengths* wavelengths) const {
        const float mu = std::clamp(cos_theta, 0.0f, 1.0f), away = 1.0f - mu;
        const float away2 = away * away, away5 = away2 * away2 * away;
        glm::vec3 f = glm::clamp(schlick(away5) - mu * away5 * away * dip(), 0.0f, 1.0f);
        if (film && film->weight > 0.0f) f = glm::mix(f, under_film(mu, wavelengths), film->weight);
        return weight * f;
    }
    /// F̄.
    glm::vec3 average() const {
        return weight * glm::clamp(normal + (1.0f - normal) / 21.0f - dip() / 126.0f, 0.0f, 1.0f);
    }

  private:
    glm::vec3 schlick(float away5) const { return normal + (1.0f - normal) * away5; }
    /// a.
    glm::vec3 dip() const {
        constexpr float mu = 1.0f / 7.0f, away = 1.0f - mu, away5 = away * away * away * away * away;
        return (1.0f - edge) * schlick(away5) / (mu * away5 * away);
    }
    glm::vec3 under_film(float mu, const Wavelengths* wavelengths) const;
};

}  // namespace phasetree::tracer
