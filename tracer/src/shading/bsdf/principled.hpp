// A layered standard material after OpenPBR Surface 1.1, without its transmission and subsurface scattering:
//
//   fuzz       over w_f of the surface    fuzz.hpp
//   coat       over C of the surface      a dielectric layer that may absorb light
//   base                                  principled_base.hpp: metal, and a gloss over a diffuse base
//
//   f = w_f c_f f_fuzz + (1 − w_f E_fuzz(o)) ((1 − C) f_bare + C f_coated)
//   f_coated = F D G₂/(4 |o.z| |i.z|) + (1 − E_coat(o)) a(o) a(i) Δ f_base
//
// Layers are combined by their directional albedos E, so no light is lost or gained between them, whatever the
// settings: the sum reflects all light if nothing absorbs, and never more. Scaling by E(o) alone is not reciprocal.
// Without coat and fuzz, f is.
//
//   a(ω) = c_coat^(1/(2 μₜ))        absorption on the way through the coat, refracted to the cosine μₜ
//   Δ    = 1 + d ((1 − K)/(1 − E_b K) − 1)
//
// Δ is the darkening of the base by light that the coat sends back to it: E_b is the base's albedo at normal incidence,
// K the part that is sent back, a mix of that of a smooth base, F(o.z), and that of a diffuse one, 1 − (1 − Ē_coat)/η²,
// by the roughness of the base. Below the coat, the base's index is relative to that of the coat, and the square of its
// α increases by 2 α_coat².
//
// What differs from OpenPBR 1.1:
//   * Transmission, subsurface scattering and thin walls are missing.
//   * The specular weight multiplies the dielectric's reflectance instead of changing its index.
//   * The rough dielectric loses no light to multiple scattering: it reaches the base.
//   * The metal under a thin film is that of the film on an index derived from its colour, without the edge tint.
//   * Where the coat covers part of the surface, both parts are evaluated, instead of one with a mean index and a mean
//     roughness.
//   * The fuzz is that of Estevez and Kulla, scaled by albedo, not the fit of Zeltner et al., whose tables come from
//     simulations that are not reproduced here. Its roughness is squared, as in glTF, and has a lower bound.
//   * The grain applies to metal and gloss; the coat is isotropic. Coat and base have the same normal.
//   * Emission (interface.hpp) is the same in all directions; coat and fuzz do not absorb it.
//
// References: OpenPBR Surface 1.1 (Academy Software Foundation, 2024); Kutz, Hašan & Edmondson, Novel Aspects of the
// Adobe Standard Material, 2021 (index below the coat).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/fuzz.hpp"
#include "shading/bsdf/principled_base.hpp"

namespace phasetree::tracer {

/// The coat at a point.
struct PrincipledCoat {
    float weight = 0.0f;     ///< C
    glm::vec3 color{1.0f};   ///< of light that passes it twice at normal incidence
    float darkening = 1.0f;  ///< d
    float eta = 1.6f;        ///< its index over that of the medium outside
};

/// The fuzz at a point.
struct PrincipledFuzz {
    float weight = 0.0f;    ///< w_f
    glm::vec3 color{1.0f};  ///< c_f
};

class PrincipledBsdf {
  public:
    /// A surface without coat and fuzz.
    explicit PrincipledBsdf(const PrincipledBase& bare) : bare_(bare) {}
    /// Adds a coat. `coated` is the base below it.
    PrincipledBsdf& add(const PrincipledCoat& coat, const DielectricLayer::At& layer, const PrincipledBase& coated);
    PrincipledBsdf& add(const PrincipledFuzz& kind, const Fuzz& fuzz);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return is_metal() && bare_.is_delta(); }
    bool passes_through() const { return false; }
    /// Whether it is metal only, without coat and fuzz.
    bool is_metal() const { return !coat_ && !fuzz_ && bare_.is_metal(); }
    bool is_diffuse() const { return bare_.is_diffuse() || (fuzz_ && fuzz_->kind.weight > 0.0f); }

  private:
    class Coat {
      public:
        Coat(const PrincipledCoat& kind, const DielectricLayer::At& layer, const PrincipledBase& base);

        float weight() const { return kind_.weight; }
        const DielectricLayer::At& layer() const { return layer_; }
        const PrincipledBase& base() const { return base_; }
        glm::vec3 absorption(float cosine) const;      ///< a
        glm::vec3 to_base(const glm::vec3& wo) const;  ///< (1 − E(o)) a(o) Δ

      private:
        PrincipledCoat kind_;
        DielectricLayer::At layer_;
        PrincipledBase base_;
        glm::vec3 base_albedo_;           ///< E_b
        float base_roughness_;            ///< how much of K is that of a diffuse base
        glm::vec3 sent_back_to_diffuse_;  ///< K of a diffuse base
    };
    struct WithFuzz {
        PrincipledFuzz kind;
        Fuzz fuzz;

        float reflected(const glm::vec3& wo) const { return kind.weight * fuzz.reflected(wo.z); }
    };
    /// What depends on the direction of view only.
    struct Parts {
        float bare = 1.0f;        ///< share of the light that meets the bare surface
        float coated = 0.0f;      ///< share that meets the coat
        glm::vec3 to_base{0.0f};  ///< share that reaches the base below the coat, but for a(i)
        // The probabilities of sampling each part; that of the bare surface is the rest.
        float choose_fuzz = 0.0f, choose_coat = 0.0f, choose_base = 0.0f;
        float choose_bare() const { return 1.0f - choose_fuzz - choose_coat - choose_base; }
        bool is_black = false;
    };
    Parts parts_for(const glm::vec3& wo) const;
    glm::vec3 evaluate(const Parts& parts, const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const Parts& parts, const glm::vec3& wo, const glm::vec3& wi) const;

    PrincipledBase bare_;
    std::optional<Coat> coat_;
    std::optional<WithFuzz> fuzz_;
};

}  // namespace phasetree::tracer
