// A homogeneous scattering medium. With σt = σa + σs, the transmittance is T(t) = exp(−σt t).
//
// A free flight is sampled by one channel k, with the pdf σt_k T_k(t). The channel is chosen with the probability q_k,
// proportional to the path's throughput β. The weight of every channel c accounts for all choices (the balance
// heuristic over channels),
//     scattered at t:    σs_c T_c(t) / Σ q_k σt_k T_k(t),
//     not before d:      T_c(d) / Σ q_k T_k(d).
// Then Σ β_c does not increase: Σ β_c σs_c T_c / Σ q_k σt_k T_k ≤ Σ β. So no colour becomes a firefly, however
// different the channels are. β includes the path's history, so this has the effect that hero wavelengths have on whole
// paths. The emission of the medium has a closed form, ∫₀ᵈ ε T dt = ε (1 − T(d))/σt.
//
// References: Chiang, Kutz & Burley, Practical and Controllable Subsurface Scattering for Production Path Tracing,
// SIGGRAPH 2016 talks (channels by throughput); Wilkie, Nawaz, Droske, Weidlich & Hanika, Hero Wavelength Spectral
// Sampling, EGSR 2014.
#pragma once

#include "media/coefficients.hpp"
#include "media/contract.hpp"

namespace phasetree::tracer {

class HomogeneousMedium {
  public:
    explicit HomogeneousMedium(const ScatteringCoefficients& coefficients) : coefficients_(coefficients) {}

    glm::vec3 transmittance(const Way& way, Sampler&) const;
    Passage pass(const Way& way, Sampler& sampler) const;
    Flight fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const;
    const PhaseFunction& phase_function() const { return coefficients_.phase_function; }
    const ScatteringCoefficients& coefficients() const { return coefficients_; }

  private:
    ScatteringCoefficients coefficients_;
};

}  // namespace phasetree::tracer
