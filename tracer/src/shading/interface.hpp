// The optics where one material meets another.
//
//   clear | clear     refraction and reflection with η_to/η_from, without a gap between the two
//   clear | opaque    the surface of the opaque one, relative to the index of the clear one: metal and varnish reflect
//                     less in water than in air
//   clear | thin      that of a thin mesh in the clear material, which is also behind it
//   clear | mixture   that of one of the two materials of the mixture, which is chosen at each point; likewise of a
//   mesh
//                     with different materials on its sides
//   opaque | any      black: light does not travel in opaque materials, so no path comes from one
//
// An interface of two clear materials has one roughness, the greater of the two: a ground surface stays ground where it
// touches a polished one. Vacuum is smooth, so that a material against vacuum has its own roughness.
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
#include "shading/principled_surface.hpp"
#include "shading/shared_surfaces.hpp"

namespace phasetree::tracer {

/// The optics of an ordered pair of materials: of any surface, including a mesh's, where a ray in the first meets the
/// second.
class Interface {
  public:
    /// `from` is the material that the ray is in, `to` the one it meets. `shared` creates data shared by several
    /// surfaces only once.
    static Interface between(const Material& from, const Material& to, SharedSurfaces& shared);

    /// The interface with the material that a mixture, or a mesh with two sides, has at a point; otherwise the
    /// interface itself. Where the amount is between 0 and 1, a hash of the position decides, so the result is the same
    /// for every caller. A surface has the optics chosen at the point where it is met, because normals and grain are
    /// those of one of the two materials.
    const Interface& chosen_at(const TexturePoint& point) const;

    /// Whether one of a mixture's materials at a point has a BSDF that is not specular. Always false without a mixture.
    bool mixes_rough(const TexturePoint& point) const;

    /// The BSDF at a point in texture space, for light of these wavelengths or, if null, for red, green and blue. A
    /// dispersive interface refracts spectral light like its hero, and colours like the d line. The BSDF refers to data
    /// of this interface and to the wavelengths, and must not outlive them.
    Bsdf at(const TexturePoint& point, const Wavelengths* wavelengths = nullptr) const&;
    Bsdf at(const TexturePoint& point, const Wavelengths* wavelengths = nullptr) && = delete;
    /// Turns the normals of the surface; null if nothing does.
    const NormalPerturbation* perturbation() const { return perturbation_ ? &*perturbation_ : nullptr; }
    /// The grain of its surface, or null. If there is one, local x of a BSDF is along it.
    const Grain* grain() const;
    /// Whether light leaves the surface on the other side in the medium from which it came: thin materials. False for
    /// mixtures; ask the chosen interface.
    bool is_thin() const { return std::holds_alternative<ThinGlassOptics>(optics_) || is_thin_diffuse(); }
    /// Whether it transmits light diffusely, so that shadow rays and photons end there.
    bool is_thin_diffuse() const { return std::holds_alternative<ThinDiffuseOptics>(optics_); }
    /// Whether its refraction depends on the wavelength.
    bool disperses() const;

    /// The emission of a surface to the side from which it is seen, the same in all directions.
    struct Emitted {
        glm::vec3 radiance;
        std::uint32_t group;  ///< Glowing::group_number
    };
    /// For spectral light or, if `wavelengths` is null, in red, green and blue. nullopt if the surface does not emit.
    std::optional<Emitted> emitted(const TexturePoint& point, const Wavelengths* wavelengths = nullptr) const;

    struct ClearOptics {
        /// Both sides of a dispersive interface, which must be smooth and without a film of either material. Other
        /// interfaces refract all light like the d line.
        struct Dispersive {
            std::optional<Dispersion> from, to;
            float from_ior, to_ior;  ///< of a side without dispersion
        };
        std::shared_ptr<const DielectricSurface> surface;
        Number from, to;   ///< roughnesses of the two materials, of which the greater counts
        Number thickness;  ///< of the film in nanometres, as in the other kinds; 0 without a film
        std::optional<Dispersive> dispersive{};
    };
    struct MetalOptics {
        std::shared_ptr<const ConductorSurface> surface;
        Number roughness;
        Number thickness;
        std::optional<Grain> grain;
        std::shared_ptr<const Texture> reflectance{};  ///< of a metal specified by one instead of an index
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
        float radiance;  ///< where `light` is 1, in the index of the side from which it is seen
        std::uint32_t group;
    };
    struct PrincipledOptics {
        std::shared_ptr<const Principled> material;
        std::shared_ptr<const PrincipledSurface> surface;
        std::optional<GlowingOptics> emission{};
    };
    struct ThinGlassOptics {
        float eta;  ///< of the pane over the medium around it
        std::shared_ptr<const Texture> color;
        float crossings;
        Number roughness;
        std::shared_ptr<const LossTables> losses;  ///< null if it is smooth everywhere
    };
    struct ThinDiffuseOptics {
        std::shared_ptr<const Texture> color, transmission;
    };
    struct TwoSidedOptics {
        std::shared_ptr<const Interface> front, back;
    };
    struct MixedOptics {
        std::shared_ptr<const Interface> first, second;
        Number amount;  ///< of the second
    };
    using Optics = std::variant<ClearOptics, MetalOptics, DiffuseOptics, CoatedOptics, PrincipledOptics, GlowingOptics,
                                ThinGlassOptics, ThinDiffuseOptics, TwoSidedOptics, MixedOptics>;

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

    /// Throws std::out_of_range if a number is not that of a material.
    const Interface& between(std::size_t from, std::size_t to) const;

  private:
    std::size_t count_;
    std::vector<Interface> interfaces_;
};

}  // namespace phasetree::tracer
