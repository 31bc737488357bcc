// The optics where one material meets another.
//
//   clear | clear     refraction and reflection with η_to/η_from, without any gap between the two
//   clear | opaque    the opaque one's surface, seen through the clear one's index: metal and varnish reflect less in
//                     water than in air
//   clear | mixture   that of one of the two materials of the mixture, which is chosen for each place
//   opaque | any      black: light does not travel in opaque materials, so no path comes from one
//
// An interface of two clear materials has one roughness, the greater of the two: a ground surface stays ground where
// it touches a polished one. Vacuum is smooth, so that a material against vacuum has its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "shading/bsdf.hpp"
#include "shading/material.hpp"
#include "shading/shared_surfaces.hpp"

namespace phasetree::tracer {

/// The optics of an ordered pair of materials: of any surface, also a mesh's, where a ray in the one meets the other.
class Interface {
  public:
    /// `from` is the material the ray is in, `to` the one it meets. What surfaces share is made only once.
    static Interface between(const Material& from, const Material& to, SharedSurfaces& shared);

    /// The interface with the material that a mixture has at a place; itself if it is of no mixture. Where the amount
    /// is between 0 and 1 a number decides that is hashed from the position, so all who ask for one place are told the
    /// same. A surface has the optics that are chosen where it is met, because normals and grain are those of one of
    /// the two.
    const Interface& chosen_at(const TexturePoint& point) const;

    /// Whether one of a mixture's materials at a place has a BSDF that is no mirror; of what is no mixture nothing is
    /// asked, and it is false.
    bool mixes_rough(const TexturePoint& point) const;

    /// The BSDF at a place, which is in the space textures are defined in, for light of these wavelengths or, without
    /// any, for red, green and blue. Where the interface disperses it refracts light of wavelengths as the hero, and
    /// that of colours as the line d. It refers to data of this interface and to the wavelengths, and must not outlive
    /// them.
    Bsdf at(const TexturePoint& point, const Wavelengths* wavelengths = nullptr) const&;
    Bsdf at(const TexturePoint& point, const Wavelengths* wavelengths = nullptr) && = delete;
    /// What turns the normals of the surface, if anything does.
    const NormalPerturbation* perturbation() const { return perturbation_ ? &*perturbation_ : nullptr; }
    /// The grain of its surface, if it has any: then local x of a BSDF is along it.
    const Grain* grain() const;
    /// Whether it refracts light of different wavelengths differently.
    bool disperses() const;

    /// What a surface sends by itself to the side from which it is seen, the same to all directions.
    struct Emitted {
        glm::vec3 radiance;
        std::uint32_t group;  ///< Glowing::group_number
    };
    /// In light of wavelengths or, without any, in red, green and blue. None if the surface does not glow.
    std::optional<Emitted> emitted(const TexturePoint& point, const Wavelengths* wavelengths = nullptr) const;

    struct ClearOptics {
        /// Both sides of an interface that disperses light: one that is smooth and has no film, of its own or of the
        /// other material. Where it has, it refracts all light as that of the line d.
        struct Dispersive {
            std::optional<Dispersion> from, to;
            float from_ior, to_ior;  ///< of a side without dispersion
        };
        std::shared_ptr<const DielectricSurface> surface;
        Number from, to;   ///< the roughnesses of the two materials, of which the greater counts
        Number thickness;  ///< of the film in nanometres, as in the other kinds; 0 without one
        std::optional<Dispersive> dispersive{};
    };
    struct MetalOptics {
        std::shared_ptr<const ConductorSurface> surface;
        Number roughness;
        Number thickness;
        std::optional<Grain> grain;
        std::shared_ptr<const Texture> reflectance{};  ///< of a metal that has one instead of an index
    };
    struct DiffuseOptics {
        std::shared_ptr<const Texture> color;
        Number roughness = 0.0f;
    };
    struct CoatedOptics {
        std::shared_ptr<const Texture> color;
        std::shared_ptr<const CoatingAlbedo> coating;
        Number roughness;
        Number thickness;
    };
    struct GlowingOptics {
        std::shared_ptr<const Texture> color, light;
        SharedLightSpectrum spectrum;
        float radiance;  ///< where `light` is 1, in the index of the side it is seen from
        std::uint32_t group;
    };
    struct MixedOptics {
        std::shared_ptr<const Interface> first, second;
        Number amount;  ///< of the second
    };
    using Optics = std::variant<ClearOptics, MetalOptics, DiffuseOptics, CoatedOptics, GlowingOptics, MixedOptics>;

  private:
    explicit Interface(Optics optics, std::optional<NormalPerturbation> perturbation = std::nullopt)
        : optics_(std::move(optics)), perturbation_(std::move(perturbation)) {}

    Optics optics_;
    std::optional<NormalPerturbation> perturbation_;
};

/// The interfaces of every ordered pair of materials, built once.
class InterfaceTable {
  public:
    InterfaceTable(std::span<const Material> materials, SharedSurfaces& shared);

    /// Throws std::out_of_range for the number of no material.
    const Interface& between(std::size_t from, std::size_t to) const;

  private:
    std::size_t count_;
    std::vector<Interface> interfaces_;
};

}  // namespace phasetree::tracer
