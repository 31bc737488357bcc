#pragma once

#include "phasetree/nodes/fields/fold.hpp"
#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// The layer is L = {m < 0} ∩ A₀ and the vacuum A₀ − L: φ₀ = max(a₀, −m).
///
/// I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): φₖ + φ₀ ≥ m − m, φₖ + aᵢ ≥ a₀ + aᵢ, φ₀ + aᵢ ≥ a₀ + aᵢ.
struct SmoothLayered {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"smooth_layered", "4.5",
                                   "m = smin over i of aᵢ, less t;  φₖ = max(m, a₀),  φ₀ = max(a₀, −m)",
                                   "Embeds an object in a layer that fills the grooves between its phases, which are "
                                   "blended in the order of their indices."};
    Phased of{};
    Phase phase{1};
    float thickness = 0.1f;
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothLayered::of, Parameter{"of", "", "The object."});
        v(&SmoothLayered::phase, Parameter{"phase", "", "The phase of the layer."});
        v(&SmoothLayered::thickness,
          Parameter{"thickness", "m", "Thickness of the layer away from the grooves.", limits::positive});
        v(&SmoothLayered::radius, detail::blend);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        if (!a.has(0) || a.materials() == 0) return a;  // no vacuum outside, or no material inside
        std::optional<typename D::Scalar> blended;
        for_each_phase(a.materials(), [&](int i) { blended = blended ? smooth_min(*blended, a[i], radius) : a[i]; });
        const auto reached = *blended - thickness;
        const auto layer = max(reached, a[0]);
        a.set(phase.index, a.has(phase.index) ? min(a[phase.index], layer) : layer);
        a.set(0, max(a[0], -reached));
        return a;
    }
    PhaseSet phases() const {
        const PhaseSet there = phasetree::phases(of);
        return there.contains(vacuum) && there.size() > 1 ? there | PhaseSet::of(phase) : there;
    }
    /// Each step lowers the minimum by at most r/6.
    Bounds bounds(BoundsQuery& q, float level) const {
        return q(of, level + thickness + radius / 6 * static_cast<float>(phasetree::phases(of).size()));
    }
};

}  // namespace phasetree
