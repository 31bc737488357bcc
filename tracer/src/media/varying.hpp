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

namespace phasetree::tracer {

class VaryingMedium {
  public:
    /// The coefficients are those at density 1.
    VaryingMedium(const ScatteringCoefficients& coefficients, const Density& density);

    glm::vec3 transmittance(const Way& way, Sampler& sampler) const { return pass(way, sampler).left; }
    Passage pass(const Way& way, Sampler& sampler) const;
    Flight fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const;
    const HenyeyGreenstein& phase_function() const { return coefficients_.phase_function; }
    const ScatteringCoefficients& coefficients() const { return coefficients_; }
    /// The share of the coefficients at eight points.
    BatchOfFloats density_at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const {
        return tracer::density_at(density_, x, y, z);
    }
    /// A box outside of which there is nothing of it.
    const Bounds& bounds() const { return bounds_of(density_); }

  private:
    template <class Visit>
    void for_each_tentative_collision(const Way& way, Sampler& sampler, float least, Visit&& visit) const;

    ScatteringCoefficients coefficients_;
    Density density_;
    float densest_;  ///< max σt where ρ is 1
};

}  // namespace phasetree::tracer
