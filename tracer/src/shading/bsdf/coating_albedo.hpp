// The albedo of a dielectric coating, averaged as needed for the layer below it.
//
//   E(μ)   the coating's directional albedo from outside: Fresnel's F(μ) when smooth; when rough, the GGX integral of F
//          over the visible normals, tabulated
//   E_avg  = 2 ∫ E(μ) μ dμ, the albedo under uniform light
//   F_int  = 1 − (1 − E_avg)/η², the part of diffuse light from inside that is reflected back inside, by reciprocity
//
// All light that is not reflected at once reaches the base, including light that meets microfacets again, so that no
// energy is lost.
//
// η is the coating's index relative to the adjacent clear medium. It may be less than 1 (varnish under a denser
// liquid): then E is 1 beyond the critical angle, and the equations still hold. With a thin film on the coating, E
// differs by colour.
//
// Reference for the reciprocity: Egan & Hilgeman, Optical Properties of Inhomogeneous Materials, 1979, chapter 6.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "shading/bsdf/dielectric_surface.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class CoatingAlbedo {
  public:
    /// `roughness` is GGX's α; 0 is smooth.
    CoatingAlbedo(float eta, float roughness)
        : CoatingAlbedo(DielectricSurface(1.0f, eta), ValueRange{roughness, roughness}, ValueRange{}) {}
    /// `surface` is the interface from the clear medium into the coating. Roughness varies over the surface in its
    /// range, and so does the thickness of the film where the coating is smooth. Where it is rough, the film has the
    /// middle thickness.
    CoatingAlbedo(const DielectricSurface& surface, const ValueRange& roughness, const ValueRange& film_thickness);

    /// The albedo at one point.
    class At {
      public:
        float roughness() const { return roughness_; }
        glm::vec3 fresnel(float cos_theta) const {
            return for_light(albedo_->surface_.fresnel(cos_theta, thickness_).reflectance, wavelengths_);
        }
        glm::vec3 directional(float cos_theta) const;  ///< E(μ)
        glm::vec3 average() const { return for_light(average_, wavelengths_); }
        glm::vec3 internal() const;

      private:
        friend class CoatingAlbedo;
        At(const CoatingAlbedo& albedo, float roughness, float thickness, const Wavelengths* wavelengths);

        const CoatingAlbedo* albedo_;
        float roughness_, thickness_;
        const Wavelengths* wavelengths_;
        std::size_t below_ = 0;  ///< the table of the next lower roughness
        float part_ = 0.0f;      ///< interpolation weight of the next table, in [0, 1]
        glm::vec3 average_{0.0f};
    };
    /// For red, green and blue if `wavelengths` is null. With a film, wavelengths are derived from its three colours.
    At at(float roughness, float thickness = 0.0f, const Wavelengths* wavelengths = nullptr) const {
        return At(*this, roughness, thickness, wavelengths);
    }

  private:
    static constexpr std::size_t nodes = 160;  ///< at μ = (i / (nodes − 1))², dense where E is steep

    struct Table {
        std::array<glm::vec3, nodes> directional;
        glm::vec3 average;
    };

    static glm::vec3 in_table(const Table& table, float cos_theta);
    Table table_of(float roughness) const;

    DielectricSurface surface_;
    RoughnessNodes roughnesses_;  ///< of the tables
    float middle_thickness_;
    std::vector<Table> tables_;               ///< empty if the coating is nowhere rough
    std::vector<glm::vec3> smooth_averages_;  ///< where it is smooth, by the thickness of the film
    ValueRange thickness_;
};

}  // namespace phasetree::tracer
