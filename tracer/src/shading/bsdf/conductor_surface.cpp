#include "shading/bsdf/conductor_surface.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "shading/bsdf/visible_normals.hpp"
#include "shading/fresnel.hpp"
#include "shading/roughness.hpp"

namespace phasetree::tracer {

namespace {

// For a metal that reflects everything: the part of the light that is not shadowed on its way out.
LossTable loss_table_of(const Ggx& ggx, bool has_grain) {
    const auto leaves = [&](const glm::vec3& wo, const glm::vec3& m) {
        const glm::vec3 wi = 2.0f * glm::dot(wo, m) * m - wo;
        return glm::vec3(wi.z > 0.0f ? ggx.shadowing_of_reflected(wo, wi) : 0.0f);
    };
    if (!has_grain)
        return LossTable([&](float cos_theta) { return mean_over_visible_normals(ggx, cos_theta, leaves); });
    return LossTable([&](float cos_theta, float sin_phi) {
        const float sine = std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta));
        const glm::vec3 wo{sine * std::sqrt(std::max(0.0f, 1.0f - sin_phi * sin_phi)), sine * sin_phi, cos_theta};
        return mean_over_visible_normals(ggx, wo, leaves);
    });
}

// q: the part of multiply scattered light that leaves the surface at each further scattering.
float gets_away(float roughness) {
    return 1.0f / (1.0f + (0.5f + 0.2f * roughness) * roughness);
}

// 2 ∫ F μ dμ by the midpoint rule.
template <class Fresnel>
auto mean_over_cosine(const Fresnel& fresnel) {
    constexpr int steps = 512;
    auto sum = 0.0f * fresnel(0.5f);
    for (int i = 0; i < steps; ++i) {
        const float mu = (static_cast<float>(i) + 0.5f) / steps;
        sum += 2.0f * mu / steps * fresnel(mu);
    }
    return sum;
}

// The wavelengths of the table of a spectrum.
constexpr float first_nanometre = 380.0f, nanometre_step = 5.0f;
constexpr int spectrum_nodes = 81;

// F̄ is linear between this many reflectances.
constexpr int reflectance_nodes = 129;

}  // namespace

ConductorSurface::ConductorSurface(float ior, const glm::vec3& eta, const glm::vec3& k,
                                   const std::optional<ValueRange>& roughness, const std::optional<FilmOfSurface>& film,
                                   std::span<const MetalPoint> spectrum, float aspect,
                                   std::shared_ptr<const LossTables> losses)
    : ior_(ior), aspect_(aspect), eta_(eta / ior), k_(k / ior) {
    if (film) film_.emplace(ThinFilm::Layers{ior, film->ior, eta, k}, film->thickness.least, film->thickness.greatest);
    // Indices for red, green and blue are assumed to be those at the wavelengths to which the indices of metals refer.
    const std::array<MetalPoint, 3> by_colours{{{450, eta.z, k.z}, {550, eta.y, k.y}, {650, eta.x, k.x}}};
    if (spectrum.empty()) spectrum = by_colours;
    for (int i = 0; i < spectrum_nodes; ++i) {
        const MetalPoint index = index_at(spectrum, first_nanometre + nanometre_step * static_cast<float>(i));
        AtWavelength at{index.eta / ior, index.k / ior, 0.0f};
        if (roughness)
            at.mean_reflectance = mean_over_cosine([&](float mu) { return fresnel_conductor(mu, at.eta, at.k); });
        spectrum_.push_back(at);
    }
    if (!roughness) return;
    losses_ = losses ? std::move(losses) : losses_of(*roughness, aspect);
    mean_reflectance_ = mean_over_cosine([&](float mu) { return fresnel_conductor(mu, eta_, k_); });
}

ConductorSurface ConductorSurface::of_reflectance(float ior, const std::optional<ValueRange>& roughness, float aspect,
                                                  std::shared_ptr<const LossTables> losses) {
    ConductorSurface surface(ior, glm::vec3(1.0f), glm::vec3(0.0f), roughness, {}, {}, aspect, std::move(losses));
    if (!roughness) return surface;
    for (int i = 0; i < reflectance_nodes; ++i) {
        const float k = k_of_reflectance(static_cast<float>(i) / (reflectance_nodes - 1));
        surface.mean_reflectances_.push_back(
            mean_over_cosine([&](float mu) { return fresnel_conductor(mu, 1.0f / ior, k / ior); }));
    }
    return surface;
}

float ConductorSurface::mean_of_reflectance(float reflectance) const {
    const float position = std::clamp(reflectance, 0.0f, 1.0f) * (reflectance_nodes - 1);
    const auto below = std::min(static_cast<std::size_t>(position), std::size_t{reflectance_nodes - 2});
    return glm::mix(mean_reflectances_[below], mean_reflectances_[below + 1], position - static_cast<float>(below));
}

std::shared_ptr<const LossTables> ConductorSurface::losses_of(const ValueRange& roughness, float aspect) {
    return std::make_shared<const LossTables>(
        roughness, [&](float alpha) { return loss_table_of(microfacets(alpha, aspect), aspect != 1.0f); });
}

Ggx ConductorSurface::microfacets(float roughness, float aspect) {
    return {std::min(roughness, std::max(aspect * roughness, least_roughness)), roughness};
}

ConductorSurface::AtWavelength ConductorSurface::at(float nanometres) const {
    const float position =
        std::clamp((nanometres - first_nanometre) / nanometre_step, 0.0f, static_cast<float>(spectrum_nodes - 1));
    const auto below = std::min(static_cast<std::size_t>(position), std::size_t{spectrum_nodes - 2});
    const float part = position - static_cast<float>(below);
    const AtWavelength &a = spectrum_[below], &b = spectrum_[below + 1];
    return {glm::mix(a.eta, b.eta, part), glm::mix(a.k, b.k, part),
            glm::mix(a.mean_reflectance, b.mean_reflectance, part)};
}

glm::vec3 ConductorSurface::fresnel(float cos_theta, const Place& place) const {
    const auto& [thickness, wavelengths, reflectance, by_colours] = place;
    if (by_colours) return by_colours->reflectance(cos_theta, wavelengths);
    if (reflectance) return fresnel_conductor(cos_theta, glm::vec3(1.0f / ior_), k_of_reflectance(*reflectance) / ior_);
    if (!has_spectrum_for(wavelengths))
        return for_light(film_ ? film_->reflectance(cos_theta, thickness) : fresnel_conductor(cos_theta, eta_, k_),
                         wavelengths);
    glm::vec3 eta, k;
    for (int i = 0; i < 3; ++i) {
        const AtWavelength index = at(wavelengths->nanometres[i]);
        eta[i] = index.eta;
        k[i] = index.k;
    }
    return film_ ? film_->reflectance_at(wavelengths->nanometres, eta * ior_, k * ior_, cos_theta, thickness)
                 : fresnel_conductor(cos_theta, eta, k);
}

ConductorSurface::Multiple ConductorSurface::multiple(float roughness, const Place& place) const {
    const auto& [thickness, wavelengths, reflectance, by_colours] = place;
    const LossTables::At losses = losses_->at(roughness);
    const float q = gets_away(roughness * std::sqrt(aspect_));
    const auto reflected = [&](const glm::vec3& f) { return f * f * q / (1.0f - f * (1.0f - q)); };
    if (by_colours) return {losses, reflected(by_colours->average())};
    glm::vec3 f = for_light(film_ ? film_->average(thickness) : mean_reflectance_, wavelengths);
    if (reflectance)
        for (int i = 0; i < 3; ++i) f[i] = mean_of_reflectance((*reflectance)[i]);
    else if (!film_ && has_spectrum_for(wavelengths))
        for (int i = 0; i < 3; ++i) f[i] = at(wavelengths->nanometres[i]).mean_reflectance;
    return {losses, reflected(f)};
}

}  // namespace phasetree::tracer
