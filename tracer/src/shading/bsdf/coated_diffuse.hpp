// Varnish: a dielectric coating, smooth or rough, over a Lambertian base.
//
//   f = f_coat + T(o.z) T(i.z) / (π (1 − E_avg)) · ρ′,   ρ′ = ρ (1 − F_int) / (1 − ρ F_int),   T = 1 − E
//
// ρ′ is the base's albedo seen through the coating, including all interreflections, which darken and saturate its
// colour. As (1 − F_int) = (1 − E_avg)/η², this is T T/η² · ρ/(π (1 − ρ F_int)), the form in which it is usually
// printed. A white base under a lossless coating reflects everything. f_coat is a specular (delta) reflection when the
// coating is smooth, and GGX when it is rough. If both indices are equal, the coating vanishes and the base is plain
// Lambert.
//
// Reference: Jakob, Mitsuba renderer, plugin documentation of "plastic" and "roughplastic", 2010; coating_albedo.hpp.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/coating_albedo.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class CoatedDiffuseBsdf {
  public:
    /// The coating's albedo is shared by all points of an interface and must outlive the BSDF.
    CoatedDiffuseBsdf(const CoatingAlbedo::At& coating, const glm::vec3& base_albedo);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    bool smooth() const { return !(coating_.roughness() > 0.0f); }
    float coating_probability(const glm::vec3& reflected) const;
    glm::vec3 evaluate_base(const glm::vec3& transmitted, const glm::vec3& wi) const;

    CoatingAlbedo::At coating_;
    glm::vec3 base_;  ///< ρ′/(1 − E_avg)
    float base_brightness_;
    Ggx ggx_;
};

}  // namespace phasetree::tracer
