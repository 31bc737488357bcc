// What a scene says of a phase or a mesh, as plain values. A material is the optics of a surface, and of a clear one
// also the medium inside: light travels in phases of clear materials, and ends at the surface of all others.
//
// `roughness` is, but for what is diffuse, the α of GGX: 0 is polished, 0.1 satin, 0.5 matt; roughness.hpp says below
// which a surface is treated as perfectly smooth. What the surface between two materials does is in
// interface.hpp.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
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

/// A film of some hundred nanometres on a surface, which shows colours by interference: thin_film.hpp.
struct SurfaceFilm {
    Number thickness = 0.0f;  ///< in nanometres
    float ior = 1.33f;
};

/// Vacuum, air, water, glass.
struct Clear {
    float ior = 1.0f;   ///< the refractive index against vacuum, greater than 0
    Medium interior{};  ///< what rays travel through inside
    Number roughness = 0.0f;
    std::optional<SurfaceFilm> film{};
    /// How the index changes with the wavelength, and then `ior` is that at the line d; not at all without it.
    std::optional<Dispersion> dispersion{};

    float ior_for(const Wavelengths* wavelengths) const {
        return wavelengths && dispersion ? dispersion->index(wavelengths->hero()) : ior;
    }
};

struct Diffuse {
    Texture color = ConstantTexture{};
    Number roughness = 0.0f;  ///< bsdf/rough_diffuse.hpp; not that of GGX
    std::optional<NormalPerturbation> perturbation{};
};

/// Metal, with the complex index against vacuum; metals.hpp has measured ones.
struct Conductor {
    glm::vec3 eta{1.0f};
    glm::vec3 k{0.0f};
    Number roughness = 0.0f;
    std::optional<SurfaceFilm> film{};
    std::span<const MetalPoint> spectrum{};  ///< of a measured one, for light of wavelengths; it stays where it is
    std::optional<NormalPerturbation> perturbation{};
    std::optional<Grain> grain{};          ///< then `roughness` is that across it
    std::optional<Texture> reflectance{};  ///< at normal incidence, instead of the index; then there is no film
};

/// A diffuse base under a clear coat: varnished or glazed.
struct Coated {
    Texture color = ConstantTexture{};
    float ior = 1.5f;  ///< of the coat, against vacuum
    Number roughness = 0.0f;
    std::optional<SurfaceFilm> film{};
    std::optional<NormalPerturbation> perturbation{};
};

/// What shines by itself: embers, lava, a filament, a screen. Its surface sends the radiance `radiance` · `light` to
/// all directions of a vacuum, and n² times that within a clear material of index n, as what is hot does: through
/// smooth glass that touches it, it looks as bright as without the glass, but for what the glass reflects. What falls
/// on it is reflected diffusely.
struct Glowing {
    Texture light = ConstantTexture{glm::vec3(1.0f)};
    float radiance = 1;
    Texture color = ConstantTexture{glm::vec3(0.0f)};
    SharedLightSpectrum spectrum{};  ///< of the light, if it is known; then only the brightness of `light` counts
    std::string group{};             ///< of lights
    std::uint32_t group_number = 0;  ///< in Lights::groups()
};

struct Mixture;

/// One of two materials at each place, neither clear nor glowing: paint and the metal under it, iron and rust. Where
/// `amount` is between 0 and 1 both are there, as finely mixed as places can be told apart.
struct Mix {
    std::shared_ptr<const Mixture> of{};
    Number amount = 0.5f;  ///< how much of the second
};

/// Every kind of material.
using Material = std::variant<Clear, Diffuse, Conductor, Coated, Glowing, Mix>;

struct Mixture {
    Material first, second;
};

/// Whether one of its textures, or of its numbers that change from place to place, is of a kind, or has one of the kind
/// in it.
template <class Wanted>
bool has_texture(const Material& material) {
    return std::visit(
        [](const auto& kind) {
            bool has = false;
            if constexpr (requires { kind.amount; })
                has = has_kind<Wanted>(kind.amount) || has_texture<Wanted>(kind.of->first) ||
                      has_texture<Wanted>(kind.of->second);
            if constexpr (requires { kind.perturbation; }) {
                const Bump* bump = kind.perturbation ? std::get_if<Bump>(&*kind.perturbation) : nullptr;
                has = has || (bump && has_kind<Wanted>(bump->texture));
            }
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

/// Its map of normals, if it has one; of a mixture that of the first that has one.
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

/// Whether some of it is metal.
inline bool has_metal(const Material& material) {
    const Mix* const mix = std::get_if<Mix>(&material);
    return mix ? has_metal(mix->of->first) || has_metal(mix->of->second) : std::holds_alternative<Conductor>(material);
}

inline Material vacuum() {
    return Clear{};
}

/// Whether it shines, which a glowing one does not whose light is black everywhere.
inline bool glows(const Material& material) {
    const Glowing* glowing = std::get_if<Glowing>(&material);
    if (!glowing) return false;
    const ConstantTexture* light = std::get_if<ConstantTexture>(&glowing->light);
    return !light || light->color != glm::vec3(0.0f);
}

/// Whether its surface shines, or the medium inside.
inline bool shines(const Material& material) {
    const Clear* clear = std::get_if<Clear>(&material);
    return clear ? shines(clear->interior) : glows(material);
}

inline bool is_clear(const Material& material) {
    return std::holds_alternative<Clear>(material);
}

}  // namespace phasetree::tracer
