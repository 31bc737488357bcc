#include "shading/interface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sampling/hash.hpp"

namespace phasetree::tracer {

namespace {

ValueRange range_of(const Number& number) {
    return {least_of(number), greatest_of(number)};
}

// The part of a range of roughness that is not treated as smooth and needs tables; nullopt if all of it is smooth.
std::optional<ValueRange> rough_part(const ValueRange& roughness) {
    if (is_smooth(roughness.greatest)) return std::nullopt;
    return ValueRange{std::clamp(roughness.least, least_roughness, 1.0f), std::min(roughness.greatest, 1.0f)};
}

std::optional<FilmOfSurface> film_of(const std::optional<SurfaceFilm>& film) {
    if (!film) return std::nullopt;
    return FilmOfSurface{film->ior, range_of(film->thickness)};
}

// An interface of two clear materials has only one film.
const std::optional<SurfaceFilm>& thicker(const std::optional<SurfaceFilm>& a, const std::optional<SurfaceFilm>& b) {
    return !a || (b && greatest_of(b->thickness) > greatest_of(a->thickness)) ? b : a;
}

Number thickness_of(const std::optional<SurfaceFilm>& film) {
    return film ? film->thickness : Number(0.0f);
}

// What turns the normals where light passes from one clear material to another. An interface has only one bump, which
// is raised outwards from the material that has it, but heights are counted towards the ray.
std::optional<NormalPerturbation> perturbation_between(const Clear& from, const Clear& to) {
    const auto height = [](const Clear& of) { return of.bump ? std::abs(of.bump->height) : 0.0f; };
    if (height(to) >= height(from)) return to.bump;
    return Bump{from.bump->texture, -from.bump->height};
}

// optics_of() makes the optics of each kind of material, seen from inside a clear one.

Interface::Optics optics_of(const Clear& from, const Clear& to, SharedSurfaces& shared) {
    const std::optional<SurfaceFilm>& film = thicker(from.film, to.film);
    const ValueRange a = range_of(from.roughness), b = range_of(to.roughness);
    const ValueRange roughness{std::max(a.least, b.least), std::max(a.greatest, b.greatest)};
    Interface::ClearOptics optics{shared.dielectric(from.ior, to.ior, rough_part(roughness), film_of(film)),
                                  from.roughness, to.roughness, thickness_of(film)};
    if ((from.dispersion || to.dispersion) && is_smooth(roughness.greatest) && !film)
        optics.dispersive = Interface::ClearOptics::Dispersive{from.dispersion, to.dispersion, from.ior, to.ior};
    return optics;
}

Interface::Optics optics_of(const Clear& from, const Conductor& to, SharedSurfaces& shared) {
    const auto roughness = rough_part(range_of(to.roughness));
    const float aspect = to.grain ? to.grain->aspect : 1.0f;
    if (to.reflectance)
        return Interface::MetalOptics{shared.metal_of_reflectance(from.ior, roughness, aspect), to.roughness, 0.0f,
                                      to.grain, std::make_shared<const Texture>(*to.reflectance)};
    return Interface::MetalOptics{
        shared.conductor(from.ior, to.eta, to.k, roughness, film_of(to.film), to.spectrum, aspect), to.roughness,
        thickness_of(to.film), to.grain};
}

Interface::Optics optics_of(const Clear&, const Diffuse& to, SharedSurfaces&) {
    return Interface::DiffuseOptics{std::make_shared<const Texture>(to.color), to.roughness};
}

Interface::Optics optics_of(const Clear& from, const Coated& to, SharedSurfaces& shared) {
    ValueRange roughness = range_of(to.roughness);
    if (is_smooth(roughness.least)) roughness.least = 0.0f;
    if (is_smooth(roughness.greatest)) roughness.greatest = 0.0f;
    roughness.greatest = std::min(roughness.greatest, 1.0f);
    return Interface::CoatedOptics{std::make_shared<const Texture>(to.color),
                                   shared.coating(from.ior, to.ior, roughness, film_of(to.film)), to.roughness,
                                   thickness_of(to.film)};
}

Interface::GlowingOptics glowing_optics(const Clear& from, const Glowing& to) {
    return {std::make_shared<const Texture>(to.color), std::make_shared<const Texture>(to.light), to.spectrum,
            to.radiance * from.ior * from.ior, to.group_number};
}

Interface::Optics optics_of(const Clear& from, const Glowing& to, SharedSurfaces&) {
    return glowing_optics(from, to);
}

Interface::Optics optics_of(const Clear& from, const Principled& to, SharedSurfaces& shared) {
    PrincipledRanges ranges{.outside = from.ior,
                            .ior = to.ior,
                            .coat_ior = to.coat_ior,
                            .aspect = to.grain ? to.grain->aspect : 1.0f,
                            .diffuse_roughness = range_of(to.diffuse_roughness),
                            .metalness = range_of(to.metalness),
                            .roughness = range_of(to.roughness),
                            .coat_weight = range_of(to.coat_weight),
                            .coat_roughness = range_of(to.coat_roughness),
                            .fuzz_weight = range_of(to.fuzz_weight),
                            .fuzz_roughness = range_of(to.fuzz_roughness)};
    if (greatest_of(to.film_weight) > 0.0f) ranges.film = film_of(to.film);
    Interface::PrincipledOptics optics{std::make_shared<const Principled>(to),
                                       std::make_shared<const PrincipledSurface>(ranges, shared)};
    if (to.emission) optics.emission = glowing_optics(from, *to.emission);
    return optics;
}

Interface::Optics optics_of(const Clear& from, const ThinGlass& to, SharedSurfaces& shared) {
    return Interface::ThinGlassOptics{to.ior / from.ior, std::make_shared<const Texture>(to.color), to.crossings,
                                      to.roughness, shared.losses(rough_part(range_of(to.roughness)))};
}

Interface::Optics optics_of(const Clear&, const ThinDiffuse& to, SharedSurfaces&) {
    return Interface::ThinDiffuseOptics{std::make_shared<const Texture>(to.color),
                                        std::make_shared<const Texture>(to.transmission)};
}

Interface::Optics optics_of(const Clear& from, const TwoSided& to, SharedSurfaces& shared) {
    const auto seen_from = [&](const Material& material) {
        return std::make_shared<const Interface>(Interface::between(from, material, shared));
    };
    return Interface::TwoSidedOptics{seen_from(to.of->first), seen_from(to.of->second)};
}

Interface::Optics optics_of(const Clear& from, const Mix& to, SharedSurfaces& shared) {
    const auto seen_from = [&](const Material& material) {
        return std::make_shared<const Interface>(Interface::between(from, material, shared));
    };
    return Interface::MixedOptics{seen_from(to.of->first), seen_from(to.of->second), to.amount};
}

Bsdf dispersive_bsdf(const Interface::ClearOptics::Dispersive& sides, float hero) {
    const auto index = [&](const std::optional<Dispersion>& side, float ior) { return side ? side->index(hero) : ior; };
    return SmoothDielectricBsdf(index(sides.from, sides.from_ior), index(sides.to, sides.to_ior));
}

// The second of a mixture's materials is chosen where this number is below its amount. A mixture inside a mixture is on
// the next level, with a number of its own.
float threshold_at(const TexturePoint& p, std::uint32_t level) {
    return hash_to_unit(hash_of(p.position, p.copy, level));
}

// bsdf_of() makes the BSDF of each kind of optics at a point, for spectral light or, if `wavelengths` is null, for
// colours.

Bsdf bsdf_of(const Interface::ClearOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    const float thickness = number_at(optics.thickness, p);
    // Between equal indices there is at most a film. Light that passes it goes straight on, however rough it is, and no
    // microfacet would refract it there.
    if (optics.surface->eta() == 1.0f) return SmoothDielectricBsdf(*optics.surface, thickness, wavelengths);
    const float roughness = std::max(number_at(optics.from, p), number_at(optics.to, p));
    if (is_smooth(roughness)) return SmoothDielectricBsdf(*optics.surface, thickness, wavelengths);
    return RoughDielectricBsdf(*optics.surface, std::min(roughness, 1.0f), wavelengths);
}

Bsdf bsdf_of(const Interface::MetalOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    ConductorSurface::Place place{number_at(optics.thickness, p), wavelengths};
    if (optics.reflectance) place.reflectance = color_at(*optics.reflectance, p, wavelengths);
    const float roughness = number_at(optics.roughness, p);
    if (is_smooth(roughness)) return SmoothConductorBsdf(*optics.surface, place);
    return RoughConductorBsdf(*optics.surface, std::min(roughness, 1.0f), place);
}

Bsdf bsdf_of(const Interface::DiffuseOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    const glm::vec3 color = color_at(*optics.color, p, wavelengths);
    const float roughness = number_at(optics.roughness, p);
    if (roughness > 0.0f) return RoughDiffuseBsdf(color, std::min(roughness, 1.0f));
    return DiffuseBsdf(color);
}

Bsdf bsdf_of(const Interface::CoatedOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    const float roughness = number_at(optics.roughness, p);
    return CoatedDiffuseBsdf(optics.coating->at(is_smooth(roughness) ? 0.0f : std::min(roughness, 1.0f),
                                                number_at(optics.thickness, p), wavelengths),
                             color_at(*optics.color, p, wavelengths));
}

Bsdf bsdf_of(const Interface::PrincipledOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    const Principled& m = *optics.material;
    const auto number = [&](const Number& of) { return number_at(of, p); };
    const auto color = [&](const Texture& of) { return color_at(of, p, wavelengths); };
    PrincipledPoint point{.base_weight = number(m.base_weight),
                          .base_color = color(m.color),
                          .diffuse_roughness = number(m.diffuse_roughness),
                          .metalness = number(m.metalness),
                          .specular_weight = number(m.specular_weight),
                          .specular_color = color(m.specular_color),
                          .roughness = number(m.roughness),
                          .coat_weight = number(m.coat_weight),
                          .fuzz_weight = number(m.fuzz_weight)};
    if (point.coat_weight > 0.0f) {
        point.coat_color = color(m.coat_color);
        point.coat_roughness = number(m.coat_roughness);
        point.coat_darkening = number(m.coat_darkening);
    }
    if (point.fuzz_weight > 0.0f) {
        point.fuzz_color = color(m.fuzz_color);
        point.fuzz_roughness = number(m.fuzz_roughness);
    }
    if (m.film) {
        point.film_weight = number(m.film_weight);
        point.film_thickness = number(m.film->thickness);
    }
    return optics.surface->at(point, wavelengths);
}

Bsdf bsdf_of(const Interface::GlowingOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    return DiffuseBsdf(color_at(*optics.color, p, wavelengths));
}

Bsdf bsdf_of(const Interface::ThinGlassOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    glm::vec3 color = color_at(*optics.color, p, wavelengths);
    if (optics.crossings != 1.0f)
        for (int i = 0; i < 3; ++i) color[i] = std::pow(color[i], optics.crossings);
    const ThinPane pane(optics.eta, color);
    const float roughness = number_at(optics.roughness, p);
    // Between equal indices the pane is a filter, and no microfacet would refract light.
    if (optics.eta == 1.0f || is_smooth(roughness)) return SmoothThinGlassBsdf(pane);
    const float alpha = std::min(roughness, 1.0f);
    return RoughThinGlassBsdf(pane, alpha, optics.losses->at(alpha));
}

Bsdf bsdf_of(const Interface::ThinDiffuseOptics& optics, const TexturePoint& p, const Wavelengths* wavelengths) {
    return ThinDiffuseBsdf(color_at(*optics.color, p, wavelengths), color_at(*optics.transmission, p, wavelengths));
}

}  // namespace

const Interface& Interface::chosen_at(const TexturePoint& point) const {
    const Interface* chosen = this;
    for (std::uint32_t level = 0;;) {
        if (const auto* mixed = std::get_if<MixedOptics>(&chosen->optics_))
            chosen = threshold_at(point, level++) < number_at(mixed->amount, point) ? mixed->second.get()
                                                                                    : mixed->first.get();
        else if (const auto* sides = std::get_if<TwoSidedOptics>(&chosen->optics_))
            chosen = point.is_back ? sides->back.get() : sides->front.get();
        else
            return *chosen;
    }
}

bool Interface::mixes_rough(const TexturePoint& point) const {
    if (const auto* sides = std::get_if<TwoSidedOptics>(&optics_))
        return (point.is_back ? sides->back : sides->front)->mixes_rough(point);
    const MixedOptics* mixed = std::get_if<MixedOptics>(&optics_);
    if (!mixed) return false;
    const auto is_rough = [&](const Interface& one) {
        return std::holds_alternative<MixedOptics>(one.optics_) ? one.mixes_rough(point) : !one.at(point).is_delta();
    };
    return is_rough(*mixed->first) || is_rough(*mixed->second);
}

Interface Interface::between(const Material& from, const Material& to, SharedSurfaces& shared) {
    const Clear* clear = std::get_if<Clear>(&from);
    if (clear == nullptr)
        return Interface(DiffuseOptics{std::make_shared<const Texture>(ConstantTexture{glm::vec3(0.0f)})});
    return std::visit(
        [&](const auto& material) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(material)>, Clear>)
                return Interface(optics_of(*clear, material, shared), perturbation_between(*clear, material));
            else if constexpr (requires { material.perturbation; })
                return Interface(optics_of(*clear, material, shared), material.perturbation);
            else
                return Interface(optics_of(*clear, material, shared));
        },
        to);
}

const Grain* Interface::grain() const {
    if (const PrincipledOptics* layers = std::get_if<PrincipledOptics>(&optics_))
        return layers->material->grain ? &*layers->material->grain : nullptr;
    const MetalOptics* metal = std::get_if<MetalOptics>(&optics_);
    return metal && metal->grain ? &*metal->grain : nullptr;
}

bool Interface::disperses() const {
    const ClearOptics* clear = std::get_if<ClearOptics>(&optics_);
    return clear && clear->dispersive;
}

std::optional<Interface::Emitted> Interface::emitted(const TexturePoint& point, const Wavelengths* wavelengths) const {
    const GlowingOptics* glowing = std::get_if<GlowingOptics>(&optics_);
    if (const PrincipledOptics* layers = std::get_if<PrincipledOptics>(&optics_); layers && layers->emission)
        glowing = &*layers->emission;
    if (!glowing) return std::nullopt;
    const glm::vec3 light = glowing->spectrum ? glowing->spectrum->light(color_at(*glowing->light, point), wavelengths)
                                              : color_at(*glowing->light, point, wavelengths);
    return Emitted{glowing->radiance * light, glowing->group};
}

Bsdf Interface::at(const TexturePoint& point, const Wavelengths* wavelengths) const& {
    if (wavelengths && disperses())
        return dispersive_bsdf(*std::get<ClearOptics>(optics_).dispersive, wavelengths->hero());
    return std::visit(
        [&]<class Kind>(const Kind& optics) -> Bsdf {
            if constexpr (std::is_same_v<Kind, MixedOptics> || std::is_same_v<Kind, TwoSidedOptics>)
                return chosen_at(point).at(point, wavelengths);
            else
                return bsdf_of(optics, point, wavelengths);
        },
        optics_);
}

InterfaceTable::InterfaceTable(std::span<const Material> materials, SharedSurfaces& shared) : count_(materials.size()) {
    interfaces_.reserve(count_ * count_);
    for (const Material& from : materials) {
        for (const Material& to : materials) interfaces_.push_back(Interface::between(from, to, shared));
    }
}

const Interface& InterfaceTable::between(std::size_t from, std::size_t to) const {
    if (from >= count_ || to >= count_) throw std::out_of_range("interface table: there is no such material");
    return interfaces_[from * count_ + to];
}

}  // namespace phasetree::tracer
