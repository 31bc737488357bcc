#include "shading/bsdf/dielectric_layer.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "shading/bsdf/conductor_surface.hpp"
#include "shading/bsdf/visible_normals.hpp"

namespace phasetree::tracer {

namespace {

// T at one roughness: the rest of the light that single scattering reflects.
LossTable table_of(const DielectricSurface& surface, float roughness, float aspect) {
    const auto fresnel = [&](float cosine) { return surface.fresnel(cosine, surface.middle_thickness()).reflectance; };
    if (!(roughness > 0.0f)) return LossTable([&](float mu) { return fresnel(mu); });
    const Ggx ggx = ConductorSurface::microfacets(roughness, aspect);
    const auto reflected = [&](const glm::vec3& wo, const glm::vec3& m) {
        const float cos_o = glm::dot(wo, m);
        const glm::vec3 wi = 2.0f * cos_o * m - wo;
        return wi.z > 0.0f ? fresnel(cos_o) * ggx.shadowing_of_reflected(wo, wi) : glm::vec3(0.0f);
    };
    if (aspect == 1.0f) return LossTable([&](float mu) { return mean_over_visible_normals(ggx, mu, reflected); });
    return LossTable([&](float mu, float sin_phi) {
        const float sine = std::sqrt(std::max(0.0f, 1.0f - mu * mu));
        const glm::vec3 wo{sine * std::sqrt(std::max(0.0f, 1.0f - sin_phi * sin_phi)), sine * sin_phi, mu};
        return mean_over_visible_normals(ggx, wo, reflected);
    });
}

}  // namespace

DielectricLayer::DielectricLayer(const Kind& kind, ThinFilms& films)
    : kind_(kind), bare_(surface_of(DielectricSurface(kind.ior_from, kind.ior_to))) {
    if (kind.film)
        filmed_.emplace(surface_of(DielectricSurface(kind.ior_from, kind.ior_to, std::nullopt, kind.film, films)));
}

DielectricLayer::Surface DielectricLayer::surface_of(const DielectricSurface& dielectric) const {
    Surface surface{dielectric, LossTables(kind_.roughness, [&](float roughness) {
                        return table_of(dielectric, roughness, kind_.aspect);
                    })};
    if (kind_.has_rough_base) surface.rough_base.emplace(kind_.roughness, surface.entering);
    return surface;
}

DielectricLayer::At::At(const DielectricLayer& layer, float roughness, const glm::vec3& tint, const LayerFilm& film,
                        const Wavelengths* wavelengths)
    : layer_(&layer),
      roughness_(roughness),
      tint_(tint),
      film_(film),
      wavelengths_(wavelengths),
      ggx_(ConductorSurface::microfacets(roughness, layer.kind_.aspect)),
      bare_(layer.bare_.entering.at(roughness)),
      filmed_((layer.filmed_ ? *layer.filmed_ : layer.bare_).entering.at(roughness)) {
    if (!layer.filmed_) film_.weight = 0.0f;
    // The tables of a rough surface are those of the middle thickness.
    if (layer.filmed_ && !is_smooth()) film_.thickness = layer.filmed_->dielectric.middle_thickness();
    average_entering_ = mixed(
        [&](const Surface&, const LossTables::At& table) { return for_light(1.0f - table.average(), wavelengths_); });
    average_entering_ = 1.0f - average_entering_;
}

// E, F or the like of the bare surface and of that under the film, mixed and tinted.
template <class OfSurface>
glm::vec3 DielectricLayer::At::mixed(const OfSurface& of_surface) const {
    glm::vec3 value = of_surface(layer_->bare_, bare_);
    if (film_.weight > 0.0f) value = glm::mix(value, of_surface(*layer_->filmed_, filmed_), film_.weight);
    return tint_ * value;
}

glm::vec3 DielectricLayer::At::fresnel(float cos_theta) const {
    return mixed([&](const Surface& surface, const LossTables::At&) {
        if (surface.dielectric.has_film())
            return surface.dielectric.fresnel(cos_theta, film_.thickness, wavelengths_).reflectance;
        return surface.dielectric.fresnel(cos_theta, 0.0f).reflectance;
    });
}

glm::vec3 DielectricLayer::At::reflected(const glm::vec3& w) const {
    if (is_smooth()) return fresnel(w.z);
    return 1.0f - tabulated_entering(w);
}

glm::vec3 DielectricLayer::At::tabulated_entering(const glm::vec3& w) const {
    return 1.0f - mixed([&](const Surface&, const LossTables::At& table) {
               return for_light(1.0f - table.at(w), wavelengths_);
           });
}

glm::vec3 DielectricLayer::At::leaving(const glm::vec3& w) const {
    return tabulated_entering(w) / glm::max(average_entering_, glm::vec3(1e-6f));
}

glm::vec3 DielectricLayer::At::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    const glm::vec3 m = glm::normalize(wo + wi);
    return fresnel(glm::dot(wo, m)) * (0.25f * ggx_.distribution(m) * ggx_.reflection_visibility(wo, wi) * wi.z);
}

glm::vec3 DielectricLayer::At::sample(const glm::vec3& wo, const glm::vec2& u) const {
    const glm::vec3 m = ggx_.sample_visible_normal(wo, u);
    return 2.0f * glm::dot(wo, m) * m - wo;
}

float DielectricLayer::At::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    const glm::vec3 m = glm::normalize(wo + wi);
    return ggx_.visible_normal_pdf(wo, m) / (4.0f * glm::dot(wo, m));
}

RoughDiffuseTable::Row DielectricLayer::At::rough_base(float mu) const {
    RoughDiffuseTable::Row row = layer_->bare_.rough_base->at(roughness_, mu);
    if (film_.weight > 0.0f) row = row.mixed(layer_->filmed_->rough_base->at(roughness_, mu), film_.weight);
    // The tables are of T = 1 − E without a tint.
    const RoughDiffuseTable::Row white = RoughDiffuseTable::of_white(mu);
    const auto tinted = [&](const glm::vec3& none, const glm::vec3& all) {
        return none - tint_ * for_light(none - all, wavelengths_);
    };
    return {tinted(white.entering, row.entering), tinted(white.oren_nayar, row.oren_nayar)};
}

}  // namespace phasetree::tracer
