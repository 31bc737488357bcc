// The description of a phase or a mesh in a scene, as plain values. A material is the optics of a surface and, if it is
// clear, also the medium inside: light travels in phases of clear materials, and ends at the surface of all others.
//
// `roughness`, except that of diffuse materials, is the α of GGX: 0 is polished, 0.1 satin, 0.5 matt. roughness.hpp has
// the threshold below which a surface is perfectly smooth. interface.hpp derives the surface between two materials.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "media/medium.hpp"
#include "shading/grain.hpp"
#include "shading/metals.hpp"
#include "shading/normal_perturbation.hpp"
#include "shading/roughness.hpp"
#include "shading/texture/number.hpp"
#include "shading/texture/texture.hpp"
#include "spectrum/dispersion.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

/// A film of some hundred nanometres on a surface, which shows interference colours: thin_film.hpp.
struct SurfaceFilm {
    Number thickness = 0.0f;  ///< in nanometres
    float ior = 1.33f;
};

/// Vacuum, air, water, glass.
struct Clear {
    float ior = 1.0f;   ///< refractive index relative to vacuum, positive
    Medium interior{};  ///< the medium through which rays travel inside
    Number roughness = 0.0f;
    std::optional<SurfaceFilm> film{};
    /// The dispersion of the index, in which case `ior` is that at the d line; nullopt for a constant index.
    std::optional<Dispersion> dispersion{};
    std::optional<Bump> bump{};  ///< raised outwards

    float ior_for(const Wavelengths* wavelengths) const {
        return wavelengths && dispersion ? dispersion->index(wavelengths->hero()) : ior;
    }
};

struct Diffuse {
    Texture color = ConstantTexture{};
    Number roughness = 0.0f;  ///< bsdf/rough_diffuse.hpp; not that of GGX
    std::optional<NormalPerturbation> perturbation{};
};

/// Metal, with the complex index relative to vacuum; metals.hpp has measured ones.
struct Conductor {
    glm::vec3 eta{1.0f};
    glm::vec3 k{0.0f};
    Number roughness = 0.0f;
    std::optional<SurfaceFilm> film{};
    std::span<const MetalPoint> spectrum{};  ///< of a measured metal, for spectral light; not owned
    std::optional<NormalPerturbation> perturbation{};
    std::optional<Grain> grain{};          ///< if set, `roughness` is that across it
    std::optional<Texture> reflectance{};  ///< at normal incidence, instead of the index; excludes a film
};

/// A diffuse base under a clear coat: varnished or glazed.
struct Coated {
    Texture color = ConstantTexture{};
    float ior = 1.5f;  ///< of the coat, against vacuum
    Number roughness = 0.0f;
    std::optional<SurfaceFilm> film{};
    std::optional<NormalPerturbation> perturbation{};
};

/// An emissive surface: embers, lava, a filament, a screen. It emits the radiance `radiance` · `light` in all
/// directions into vacuum, and n² times that inside a clear material of index n, as hot bodies do: through smooth glass
/// that touches it, it looks as bright as without the glass, except for reflection losses. It reflects incident light
/// diffusely.
struct Glowing {
    Texture light = ConstantTexture{glm::vec3(1.0f)};
    float radiance = 1;
    Texture color = ConstantTexture{glm::vec3(0.0f)};
    SharedLightSpectrum spectrum{};  ///< of the light, if known; then only the brightness of `light` is used
    std::string group{};             ///< of lights
    std::uint32_t group_number = 0;  ///< in Lights::groups()
};

/// A layered surface with the parameters of OpenPBR Surface 1.1: bsdf/principled.hpp. Roughnesses are the square root
/// of GGX's α.
struct Principled {
    Number base_weight = 1.0f;
    Texture color = ConstantTexture{glm::vec3(0.8f)};  ///< of the base
    Number diffuse_roughness = 0.0f;
    Number metalness = 0.0f;
    Number specular_weight = 1.0f;
    Texture specular_color = ConstantTexture{glm::vec3(1.0f)};
    Number roughness = 0.3f;  ///< of the gloss and the metal
    float ior = 1.5f;         ///< of the gloss, against vacuum
    Number coat_weight = 0.0f;
    Texture coat_color = ConstantTexture{glm::vec3(1.0f)};
    Number coat_roughness = 0.0f;
    float coat_ior = 1.6f;
    Number coat_darkening = 1.0f;
    Number fuzz_weight = 0.0f;
    Texture fuzz_color = ConstantTexture{glm::vec3(1.0f)};
    Number fuzz_roughness = 0.5f;
    std::optional<SurfaceFilm> film{};  ///< between base and coat
    Number film_weight = 1.0f;          ///< share of the surface that has the film
    std::optional<NormalPerturbation> perturbation{};
    std::optional<Grain> grain{};       ///< of the gloss and the metal; if set, `roughness` is that across it
    std::optional<Glowing> emission{};  ///< its colour is ignored

    /// Calls a function with each texture, and with each number that may vary.
    template <class Function>
    void for_each_parameter(const Function& function) const {
        for (const Texture* texture : {&color, &specular_color, &coat_color, &fuzz_color}) function(*texture);
        for (const Number* number :
             {&base_weight, &diffuse_roughness, &metalness, &specular_weight, &roughness, &coat_weight, &coat_roughness,
              &coat_darkening, &fuzz_weight, &fuzz_roughness, &film_weight})
            function(*number);
        if (film) function(film->thickness);
        if (emission) function(emission->light);
    }
};

/// A pane without thickness, on a mesh: thin_pane.hpp. The same medium is on both sides.
struct ThinGlass {
    float ior = 1.5f;  ///< relative to vacuum
    /// The share of the light that crosses the pane once at normal incidence, without reflections, where `crossings`
    /// is 1; in general, that to this power.
    Texture color = ConstantTexture{glm::vec3(1.0f)};
    float crossings = 1.0f;
    Number roughness = 0.0f;
    std::optional<NormalPerturbation> perturbation{};
};

/// A leaf, paper, a lampshade, on a mesh: bsdf/thin_diffuse.hpp.
struct ThinDiffuse {
    Texture color = ConstantTexture{};                        ///< reflectance
    Texture transmission = ConstantTexture{glm::vec3(0.5f)};  ///< transmittance
    std::optional<NormalPerturbation> perturbation{};
};

struct Mixture;

/// An opaque mesh with different materials on its sides, neither of which is clear, thin or emissive.
struct TwoSided {
    std::shared_ptr<const Mixture> of{};  ///< first on the front, second on the back
};

/// One of two materials at each point, neither clear nor emissive: paint and the metal under it, iron and rust. Where
/// `amount` is between 0 and 1, both are mixed as finely as positions can be resolved.
struct Mix {
    std::shared_ptr<const Mixture> of{};
    Number amount = 0.5f;  ///< share of the second
};

/// Every kind of material.
using Material =
    std::variant<Clear, Diffuse, Conductor, Coated, Principled, Glowing, ThinGlass, ThinDiffuse, TwoSided, Mix>;

/// Two materials of one surface.
struct Mixture {
    Material first, second;
};

/// Whether one of its textures, or of its varying numbers, is of a kind or contains one of the kind.
template <class Wanted>
bool has_texture(const Material& material) {
    return std::visit(
        [](const auto& kind) {
            bool has = false;
            if constexpr (requires { kind.of; })
                has = has_texture<Wanted>(kind.of->first) || has_texture<Wanted>(kind.of->second);
            if constexpr (requires { kind.amount; }) has = has || has_kind<Wanted>(kind.amount);
            if constexpr (requires { kind.transmission; }) has = has || has_kind<Wanted>(kind.transmission);
            if constexpr (requires { kind.perturbation; }) {
                const Bump* bump = kind.perturbation ? std::get_if<Bump>(&*kind.perturbation) : nullptr;
                has = has || (bump && has_kind<Wanted>(bump->texture));
            }
            if constexpr (requires { kind.bump; }) has = has || (kind.bump && has_kind<Wanted>(kind.bump->texture));
            if constexpr (requires { kind.metalness; })
                kind.for_each_parameter([&](const auto& parameter) { has = has || has_kind<Wanted>(parameter); });
            if constexpr (requires { kind.light; }) has = has || has_kind<Wanted>(kind.light);
            if constexpr (requires { kind.color; }) has = has || has_kind<Wanted>(kind.color);
            if constexpr (requires { kind.reflectance; })
                has = has || (kind.reflectance && has_kind<Wanted>(*kind.reflectance));
            if constexpr (requires { kind.roughness; }) has = has || has_kind<Wanted>(kind.roughness);
            if constexpr (requires { kind.film; }) has = has || (kind.film && has_kind<Wanted>(kind.film->thickness));
            return has;
        },
        material);
}

/// Its normal map, or null; for a mixture, the first one.
inline const NormalMap* normal_map_of(const Material& material) {
    return std::visit(
        [](const auto& kind) -> const NormalMap* {
            if constexpr (requires { kind.perturbation; }) {
                return kind.perturbation ? std::get_if<NormalMap>(&*kind.perturbation) : nullptr;
            } else if constexpr (requires { kind.of; }) {
                const NormalMap* const first = normal_map_of(kind.of->first);
                return first ? first : normal_map_of(kind.of->second);
            } else {
                return nullptr;
            }
        },
        material);
}

/// Whether its surface needs the tangents of a mesh's texture coordinates.
inline bool needs_tangents(const Material& material) {
    if (normal_map_of(material)) return true;
    return std::visit(
        [](const auto& kind) {
            if constexpr (requires { kind.of; })
                return needs_tangents(kind.of->first) || needs_tangents(kind.of->second);
            else if constexpr (requires { kind.grain; })
                return kind.grain && kind.grain->in_tangents.has_value();
            else
                return false;
        },
        material);
}

/// Whether it is thin, or a mixture or one of two sides is: such materials are for meshes alone.
inline bool is_thin(const Material& material) {
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (requires { kind.of; })
                return is_thin(kind.of->first) || is_thin(kind.of->second);
            else
                return std::is_same_v<Kind, ThinGlass> || std::is_same_v<Kind, ThinDiffuse>;
        },
        material);
}

/// Whether rays pass it, in places or everywhere: a pane, or a mixture with one.
inline bool has_pane(const Material& material) {
    const Mix* const mix = std::get_if<Mix>(&material);
    return mix ? has_pane(mix->of->first) || has_pane(mix->of->second) : std::holds_alternative<ThinGlass>(material);
}

/// Whether it differs between the sides of a mesh.
inline bool has_two_sides(const Material& material) {
    const Mix* const mix = std::get_if<Mix>(&material);
    return mix ? has_two_sides(mix->of->first) || has_two_sides(mix->of->second)
               : std::holds_alternative<TwoSided>(material);
}

/// Whether part of it is metal, with nothing on it.
inline bool has_metal(const Material& material) {
    if (const Principled* const layers = std::get_if<Principled>(&material))
        return greatest_of(layers->metalness) >= 1.0f && !(least_of(layers->coat_weight) > 0.0f) &&
               !(least_of(layers->fuzz_weight) > 0.0f);
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (requires { kind.of; })
                return has_metal(kind.of->first) || has_metal(kind.of->second);
            else
                return std::is_same_v<Kind, Conductor>;
        },
        material);
}

inline Material vacuum() {
    return Clear{};
}

/// The emission of its surface; null if there is none. Ignore the colour of that of a layered surface.
inline const Glowing* emission_of(const Material& material) {
    if (const Principled* const layers = std::get_if<Principled>(&material))
        return layers->emission ? &*layers->emission : nullptr;
    return std::get_if<Glowing>(&material);
}
inline Glowing* emission_of(Material& material) {
    if (Principled* const layers = std::get_if<Principled>(&material))
        return layers->emission ? &*layers->emission : nullptr;
    return std::get_if<Glowing>(&material);
}

/// Whether it emits; false for an emissive material whose light is black everywhere.
inline bool glows(const Material& material) {
    const Glowing* glowing = emission_of(material);
    if (!glowing) return false;
    const ConstantTexture* light = std::get_if<ConstantTexture>(&glowing->light);
    return !light || light->color != glm::vec3(0.0f);
}

/// Whether its surface emits, or the medium inside.
inline bool is_emissive(const Material& material) {
    const Clear* clear = std::get_if<Clear>(&material);
    return clear ? is_emissive(clear->interior) : glows(material);
}

inline bool is_clear(const Material& material) {
    return std::holds_alternative<Clear>(material);
}

}  // namespace phasetree::tracer
