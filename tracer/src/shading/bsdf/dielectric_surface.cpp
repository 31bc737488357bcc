#include "shading/bsdf/dielectric_surface.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "sampling/ggx.hpp"
#include "shading/bsdf/visible_normals.hpp"

namespace phasetree::tracer {

float radiance_factor(float ior_from, float ior_to) {
    const double ratio = static_cast<double>(ior_from) / static_cast<double>(ior_to);
    return static_cast<float>(ratio * ratio);
}

DielectricSurface::DielectricSurface(float ior_from, float ior_to, const std::optional<ValueRange>& roughness,
                                     const std::optional<FilmOfSurface>& film)
    : DielectricSurface(ior_from, ior_to, roughness, film, *std::make_unique<ThinFilms>()) {}

DielectricSurface::DielectricSurface(float ior_from, float ior_to, const std::optional<ValueRange>& roughness,
                                     const std::optional<FilmOfSurface>& film, ThinFilms& films)
    : eta_(ior_to / ior_from),
      radiance_factor_(tracer::radiance_factor(ior_from, ior_to)),
      radiance_factor_back_(tracer::radiance_factor(ior_to, ior_from)),
      middle_thickness_(film ? film->thickness.middle() : 0.0f) {
    if (film)
        film_ =
            films.film({std::min(ior_from, ior_to), film->ior, glm::vec3(std::max(ior_from, ior_to))}, film->thickness);
    if (!roughness || is_none()) return;
    from_ = std::make_shared<const Side>(side(*roughness));
    to_ = std::make_shared<const Side>(reversed().side(*roughness));
}

DielectricSurface DielectricSurface::reversed() const {
    DielectricSurface other = *this;
    other.eta_ = 1.0f / eta_;
    std::swap(other.radiance_factor_, other.radiance_factor_back_);
    std::swap(other.from_, other.to_);
    return other;
}

DielectricSurface::Fresnel DielectricSurface::fresnel(float cos_theta, float thickness) const {
    return fresnel(cos_theta, thickness, nullptr);
}

DielectricSurface::Fresnel DielectricSurface::fresnel(float cos_theta, float thickness,
                                                      const Wavelengths* wavelengths) const {
    const auto [reflectance, cos_transmitted] = fresnel_dielectric(cos_theta, eta_);
    if (!film_) return {glm::vec3(reflectance), cos_transmitted};
    if (reflectance == 1.0f) return {glm::vec3(1.0f), cos_transmitted};
    // A lossless film reflects the same in both directions, so one table, without an edge of total reflection, is
    // enough.
    const float cosine = eta_ < 1.0f ? cos_transmitted : cos_theta;
    if (wavelengths && wavelengths->is_spectral)
        return {film_->reflectance_at(wavelengths->nanometres, cosine, thickness), cos_transmitted};
    return {for_light(film_->reflectance(cosine, thickness), wavelengths), cos_transmitted};
}

DielectricSurface::Side DielectricSurface::side(const ValueRange& roughness) const {
    const auto albedo_of = [&](float alpha) {
        const Ggx ggx(alpha);
        return LossTable([&](float cos_theta) {
            return mean_over_visible_normals(ggx, cos_theta, [&](const glm::vec3& wo, const glm::vec3& m) {
                const float cos_o = glm::dot(wo, m);
                const auto [reflectance, cos_transmitted] = fresnel(cos_o, middle_thickness_);
                const glm::vec3 reflected = 2.0f * cos_o * m - wo;
                const glm::vec3 refracted = (cos_o / eta_ - cos_transmitted) * m - wo / eta_;
                glm::vec3 sum(0.0f);
                if (reflected.z > 0.0f) sum += reflectance * ggx.shadowing_of_reflected(wo, reflected);
                if (refracted.z < 0.0f) sum += (1.0f - reflectance) * ggx.masking(refracted);
                return sum;
            });
        });
    };
    // Midpoint rule in t = √μ; 2μ dμ = 4t³ dt.
    constexpr int steps = 4096;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        sum += 4.0 * t * t * t / steps * glm::dvec3(fresnel(static_cast<float>(t * t), middle_thickness_).reflectance);
    }
    return {LossTables(roughness, albedo_of), glm::vec3(sum)};
}

DielectricSurface::Multiple DielectricSurface::multiple(float roughness) const {
    const LossTables::At from = from_->losses.at(roughness);
    const LossTables::At to = to_->losses.at(roughness);
    // n_a² L̄_a and n_b² L̄_b in units of n_a².
    const glm::vec3 weight_from = from.average();
    const glm::vec3 weight_to = to.average() * radiance_factor_back_;
    const glm::vec3 both = 2.0f - from_->mean_reflectance - to_->mean_reflectance;
    const glm::vec3 most = glm::max(glm::max(weight_from, weight_to), glm::vec3(1e-30f));
    const glm::vec3 factor = glm::min(both / glm::max(weight_from + weight_to, glm::vec3(1e-30f)), 1.0f / most);
    return {from, to, glm::min(factor * weight_to, glm::vec3(1.0f)), glm::min(factor * weight_from, glm::vec3(1.0f))};
}

}  // namespace phasetree::tracer
