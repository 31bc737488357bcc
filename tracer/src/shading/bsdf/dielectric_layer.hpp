// A dielectric interface above something opaque: the gloss of a plastic, or a clear coat.
//
//   E(ω)    its directional albedo: Fresnel's F when smooth;
//           when rough, the GGX integral of F over the visible normals,
//           tabulated
//   T = 1 − E, the light that enters, including light that meets microfacets again, so that no energy is lost
//   T̄       the same under uniform light
//
// F may be tinted by a colour at each point, as in the specular weight and colour of OpenPBR; E is then tinted too. A
// thin film may cover part of the surface, where F is the film's. If the surface has a grain along x
// (shading/grain.hpp), E depends on the azimuth.
//
// coating_albedo.hpp is the same for `coated` surfaces, without tint, partial film and grain.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/dielectric_surface.hpp"
#include "shading/bsdf/film_of_surface.hpp"
#include "shading/bsdf/lost_energy.hpp"
#include "shading/bsdf/rough_diffuse_table.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// The film of a layer at a point.
struct LayerFilm {
    float thickness = 0.0f;  ///< in nanometres
    float weight = 0.0f;     ///< share of the surface that it covers
};

class DielectricLayer {
  public:
    struct Kind {
        float ior_from, ior_to;
        ValueRange roughness;  ///< GGX's α; 0 is smooth. With a grain, it is the roughness across it
        float aspect = 1.0f;   ///< the roughness along the grain over that across
        std::optional<FilmOfSurface> film{};
        bool has_rough_base = false;  ///< whether there is a rough diffuse base below, which needs further tables

        bool operator==(const Kind&) const = default;
    };
    DielectricLayer(const Kind& kind, ThinFilms& films);
    explicit DielectricLayer(const Kind& kind) : DielectricLayer(kind, *std::make_unique<ThinFilms>()) {}

    /// The layer at one point.
    class At {
      public:
        bool is_smooth() const { return !(roughness_ > 0.0f); }
        glm::vec3 fresnel(float cos_theta) const;
        glm::vec3 reflected(const glm::vec3& w) const;                                ///< E
        glm::vec3 entering(const glm::vec3& w) const { return 1.0f - reflected(w); }  ///< T
        const glm::vec3& average_entering() const { return average_entering_; }       ///< T̄
        /// T/T̄ of the tables: the distribution, over Lambert's, of diffuse light that leaves through the layer. Its
        /// integral over the hemisphere with cos θ/π is exactly 1.
        glm::vec3 leaving(const glm::vec3& w) const;

        /// The reflection of a rough layer, f = F D G₂/(4 |o.z| |i.z|): f |cos θi|, its sampling, and its pdf.
        glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
        glm::vec3 sample(const glm::vec3& wo, const glm::vec2& u) const;  ///< may have z ≤ 0, where light is lost
        float pdf(const glm::vec3& wo, const glm::vec3& wi) const;

        /// For a rough diffuse base: T by μ, averaged over the azimuth, and ∫ T (s/t) cos θ/π dω of rough_diffuse.hpp.
        RoughDiffuseTable::Row rough_base(float mu) const;

      private:
        friend class DielectricLayer;
        At(const DielectricLayer& layer, float roughness, const glm::vec3& tint, const LayerFilm& film,
           const Wavelengths* wavelengths);

        template <class OfSurface>
        glm::vec3 mixed(const OfSurface& of_surface) const;
        glm::vec3 tabulated_entering(const glm::vec3& w) const;

        const DielectricLayer* layer_;
        float roughness_;
        glm::vec3 tint_;
        LayerFilm film_;
        const Wavelengths* wavelengths_;
        Ggx ggx_;
        LossTables::At bare_, filmed_;
        glm::vec3 average_entering_{1.0f};
    };
    /// `roughness` is in the layer's range. The tint is in the components of `wavelengths`, or red, green and blue if
    /// it is null.
    At at(float roughness, const glm::vec3& tint = glm::vec3(1.0f), const LayerFilm& film = {},
          const Wavelengths* wavelengths = nullptr) const {
        return At(*this, roughness, tint, film, wavelengths);
    }

  private:
    struct Surface {
        DielectricSurface dielectric;
        LossTables entering;
        std::optional<RoughDiffuseTables> rough_base{};
    };
    Surface surface_of(const DielectricSurface& dielectric) const;

    Kind kind_;
    Surface bare_;
    std::optional<Surface> filmed_;
};

}  // namespace phasetree::tracer
