// A medium that scatters, whose density ρ(p) in [0, 1] a field or numbers at voxels vary: σ(p) = ρ(p) σ.
//
// Distances are sampled as in a medium that is everywhere as dense as its densest channel can be, σ̄ = ρ̄ max σt, with a
// bound ρ̄ on the density that is a constant in each stretch of the way (media/density_contract.hpp). At each such
// tentative collision light is scattered really or goes on as if nothing were there (a null collision of σ̄ − σt_c ρ).
// With the throughput β of the path, its weights so far included,
//     P_s = Σ β_c σs_c ρ / Σ β_c (σs_c ρ + σ̄ − σt_c ρ),   P_n = 1 − P_s,
// and the weights become σs_c ρ/(σ̄ P_s) or (σ̄ − σt_c ρ)/(σ̄ P_n). As in a homogeneous medium Σ β_c does not grow. The
// transmittance is estimated by ratio tracking, Π (1 − σt_c ρ/σ̄) over the tentative collisions; what the medium shines
// by itself is added at these too.
//
// References: Kutz, Habel, Li & Novák, Spectral and Decomposition Tracking for Rendering Heterogeneous Volumes,
// SIGGRAPH 2017; Novák, Selle & Jarosz, Residual Ratio Tracking for Estimating Attenuation in Participating Media,
// SIGGRAPH Asia 2014; Miller, Georgiev & Jarosz, A Null-Scattering Path Integral Formulation of Light Transport,
// SIGGRAPH 2019.
#pragma once

#include "media/coefficients.hpp"
#include "media/contract.hpp"
#include "media/density.hpp"
#include "media/heat.hpp"

namespace phasetree::tracer {

class VaryingMedium {
  public:
    /// The coefficients are those at density 1, and their emission is that at the heat's own temperature, if there is
    /// heat.
    VaryingMedium(const ScatteringCoefficients& coefficients, const Density& density,
                  const std::optional<Heat>& heat = std::nullopt);

    glm::vec3 transmittance(const Way& way, Sampler& sampler) const { return pass(way, sampler).left; }
    Passage pass(const Way& way, Sampler& sampler) const;
    Flight fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const;
    const HenyeyGreenstein& phase_function() const { return coefficients_.phase_function; }
    const ScatteringCoefficients& coefficients() const { return coefficients_; }
    /// ρ at eight points.
    BatchOfFloats densities_at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const {
        return density_at(density_, x, y, z);
    }
    /// The luminance of what shines at eight points, over that of the coefficients' emission.
    BatchOfFloats brightness_at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const;
    /// What its voxels take.
    std::size_t bytes() const { return bytes_of(density_) + (heat_ ? heat_->bytes() : 0); }
    /// A box outside of which there is nothing of it.
    const Bounds& bounds() const { return bounds_of(density_); }

  private:
    // What a tentative collision is like: how far it is along the way, the density there, the rate of such collisions
    // per unit of length, and the temperature's share of the greatest, if there is heat.
    struct Collision {
        float distance, density, rate, heat;
    };
    template <class Visit>
    void for_each_tentative_collision(const Way& way, Sampler& sampler, float least, Visit&& visit) const;
    glm::vec3 emission(const ScatteringCoefficients::ForLight& coefficients, float heat, const Way& way) const {
        if (!heat_) return coefficients.emission;
        return heat_->light(heat, coefficients.emission, luminance_, way.wavelengths);
    }

    ScatteringCoefficients coefficients_;
    Density density_;
    std::optional<Heat> heat_;
    float greatest_extinction_;  ///< at least σt of any colour or wavelength, where ρ is 1
    float luminance_;            ///< of the coefficients' emission
};

}  // namespace phasetree::tracer
