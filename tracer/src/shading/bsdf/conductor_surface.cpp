#include "shading/bsdf/conductor_surface.hpp"

#include <glm/geometric.hpp>

#include "sampling/ggx.hpp"
#include "shading/bsdf/visible_normals.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer {

namespace {

// Of a metal that reflects everything: the part of the light that is not shadowed on its way out.
LossTable losses_of(float alpha) {
    const Ggx ggx(alpha);
    return LossTable([&](float cos_theta) {
        return mean_over_visible_normals(ggx, cos_theta, [&](const glm::vec3& wo, const glm::vec3& m) {
            const glm::vec3 wi = 2.0f * glm::dot(wo, m) * m - wo;
            return glm::vec3(wi.z > 0.0f ? ggx.shadowing_of_reflected(wo, wi) : 0.0f);
        });
    });
}

// The part of light scattered several times that gets away at each further scattering: q.
float gets_away(float roughness) {
    return 1.0f / (1.0f + (0.5f + 0.2f * roughness) * roughness);
}

}  // namespace

ConductorSurface::ConductorSurface(float ior, const glm::vec3& eta, const glm::vec3& k,
                                   const std::optional<ValueRange>& roughness, const std::optional<FilmOfSurface>& film)
    : eta_(eta / ior), k_(k / ior) {
    if (film) film_.emplace(ThinFilm::Layers{ior, film->ior, eta, k}, film->thickness.least, film->thickness.greatest);
    if (!roughness) return;
    losses_.emplace(*roughness, losses_of);
    // The midpoint rule for 2 ∫ F μ dμ.
    constexpr int steps = 512;
    for (int i = 0; i < steps; ++i) {
        const float mu = (static_cast<float>(i) + 0.5f) / steps;
        mean_reflectance_ += 2.0f * mu / steps * fresnel_conductor(mu, eta_, k_);
    }
}

glm::vec3 ConductorSurface::fresnel(float cos_theta, float thickness) const {
    return film_ ? film_->reflectance(cos_theta, thickness) : fresnel_conductor(cos_theta, eta_, k_);
}

ConductorSurface::Multiple ConductorSurface::multiple(float roughness, float thickness) const {
    const LossTables::At losses = losses_->at(roughness);
    const glm::vec3 f = film_ ? film_->average(thickness) : mean_reflectance_;
    const float q = gets_away(roughness);
    return {losses, f * f * q / (1.0f - f * (1.0f - q))};
}

}  // namespace phasetree::tracer
