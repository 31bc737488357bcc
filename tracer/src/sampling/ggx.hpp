// The GGX (Trowbridge-Reitz) distribution of microfacet normals, with Smith's masking and shadowing.
//
//   D(m)      = 1 / (π a b (m.x²/a² + m.y²/b² + m.z²)²)
//   G₁(w)     = 2 |w.z| / (|w.z| + √(a² w.x² + b² w.y² + w.z²))
//   G₂(o, i)  = 1 / (1 + Λ(o) + Λ(i)) for reflection (height-correlated), G₁(o) G₁(i) for transmission
//   D_o(m)    = G₁(o) max(0, o·m) D(m) / o.z, the pdf of the normals visible from `o`
//
// a and b are the roughness along x and along y. They differ on brushed metal, and elsewhere both are α; m.z > 0 and
// o.z > 0.
//
// References: Walter, Marschner, Li & Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007;
// Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014; Dupuy & Benyoub,
// Sampling Visible GGX Normals with Spherical Caps, HPG 2023.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

class Ggx {
  public:
    explicit Ggx(float alpha) : Ggx(alpha, alpha) {}
    Ggx(float alpha_x, float alpha_y) : alpha_x_(alpha_x), alpha_y_(alpha_y) {}

    float distribution(const glm::vec3& m) const {
        const float x = alpha_y_ * m.x, y = alpha_x_ * m.y, z = alpha_x_ * alpha_y_ * m.z;
        const float stretched = x * x + y * y + z * z;
        return alpha_x_ * alpha_y_ * (alpha_x_ * alpha_y_ / stretched) * (alpha_x_ * alpha_y_ / stretched) / pi;
    }

    float masking(const glm::vec3& w) const { return 2.0f * std::abs(w.z) / (std::abs(w.z) + slope_term(w)); }

    /// G₂ / (|o.z| |i.z|) for reflection; finite at grazing angles.
    float reflection_visibility(const glm::vec3& o, const glm::vec3& i) const {
        return 2.0f / (std::abs(i.z) * slope_term(o) + std::abs(o.z) * slope_term(i));
    }

    /// G₂/G₁(o): the share of the light reflected to i by the normals visible from o that leaves the surface.
    float shadowing_of_reflected(const glm::vec3& o, const glm::vec3& i) const {
        return reflection_visibility(o, i) * std::abs(o.z) * std::abs(i.z) / masking(o);
    }

    /// G₂ / (|o.z| |i.z|) for transmission.
    float transmission_visibility(const glm::vec3& o, const glm::vec3& i) const {
        return 4.0f / ((std::abs(o.z) + slope_term(o)) * (std::abs(i.z) + slope_term(i)));
    }

    /// Samples a normal visible from `o`. The normals visible on the stretched, hemispherical surface are halfway
    /// between `o` and a direction uniform on a spherical cap.
    glm::vec3 sample_visible_normal(const glm::vec3& o, const glm::vec2& u) const {
        const glm::vec3 stretched = glm::normalize(glm::vec3{alpha_x_ * o.x, alpha_y_ * o.y, o.z});
        const glm::vec3 cap = square_to_uniform_cone({u.y, u.x}, 1.0f + stretched.z);
        const glm::vec3 half = cap + stretched;
        const glm::vec3 normal{alpha_x_ * half.x, alpha_y_ * half.y, std::max(1e-9f, half.z)};
        return glm::normalize(normal);
    }

    /// D_o(m), per solid angle of m.
    float visible_normal_pdf(const glm::vec3& o, const glm::vec3& m) const {
        return 2.0f * std::max(0.0f, glm::dot(o, m)) * distribution(m) / (o.z + slope_term(o));
    }

  private:
    float slope_term(const glm::vec3& w) const {
        const float x = alpha_x_ * w.x, y = alpha_y_ * w.y;
        return std::sqrt(x * x + y * y + w.z * w.z);
    }

    float alpha_x_, alpha_y_;
};

}  // namespace phasetree::tracer
