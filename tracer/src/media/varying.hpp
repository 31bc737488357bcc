// A medium whose density ρ(p) in [0, 1] varies, given by a field or by voxels. All its coefficients are multiplied by
// the density: σ(p) = ρ(p) σ.
//
// Tentative collisions are sampled along a ray segment at a rate σ̄ ≥ ρ̄ max σt. Here ρ̄ is a bound on the density that
// is constant in each stretch of the segment (media/density_contract.hpp). σ̄ is increased where there would otherwise
// be so few collisions that estimates were noisy. Each tentative collision is either real, and light is scattered, or
// null, and light continues unchanged; null collisions fill the difference between σt ρ and σ̄. With the throughput β
// of the path, including its weights so far,
//     P_s = Σ β_c σs_c ρ / Σ β_c (σs_c ρ + σ̄ − σt_c ρ),   P_n = 1 − P_s,
// and the weights become σs_c ρ/(σ̄ P_s) or (σ̄ − σt_c ρ)/(σ̄ P_n). As in a homogeneous medium, Σ β_c does not
// increase. The transmittance is estimated by ratio tracking, Π (1 − σt_c ρ/σ̄) over the tentative collisions, at which
// emission is added, too.
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
    /// The coefficients are those at density 1. With `heat`, their emission is that at its T₀, and only its luminance
    /// is used.
    VaryingMedium(const ScatteringCoefficients& coefficients, const Density& density,
                  const std::optional<Heat>& heat = std::nullopt);

    glm::vec3 transmittance(const Way& way, Sampler& sampler) const { return pass(way, false, sampler).left; }
    Passage pass(const Way& way, Sampler& sampler) const { return pass(way, emits_, sampler); }
    Flight fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const;
    const PhaseFunction& phase_function() const { return coefficients_.phase_function; }
    const ScatteringCoefficients& coefficients() const { return coefficients_; }
    /// ρ at eight points.
    BatchOfFloats densities_at(const PointBatch& points) const { return density_at(density_, points); }
    /// The luminance of the emission at eight points, over that of the coefficients' emission.
    BatchOfFloats brightness_at(const PointBatch& points) const;
    /// The memory in bytes of its voxels.
    std::size_t bytes() const { return bytes_of(density_) + (heat_ ? heat_->bytes() : 0); }
    /// A box outside of which the medium is empty.
    const Bounds& bounds() const { return bounds_of(density_); }

  private:
    struct Collision;
    Passage pass(const Way& way, bool with_emission, Sampler& sampler) const;
    template <class Visit>
    void for_each_tentative_collision(const Way& way, Sampler& sampler, float least_collisions, Visit&& visit) const;
    // The emission at a collision, for the light of the given coefficients.
    glm::vec3 emitted_at(const Collision& collision, const ScatteringCoefficients::ForLight& coefficients,
                         const Wavelengths* wavelengths) const;

    ScatteringCoefficients coefficients_;
    Density density_;
    std::optional<Heat> heat_;
    float greatest_extinction_;  ///< at least σt of any colour or wavelength, where ρ is 1
    float luminance_;            ///< of the coefficients' emission
    bool emits_;
};

}  // namespace phasetree::tracer
