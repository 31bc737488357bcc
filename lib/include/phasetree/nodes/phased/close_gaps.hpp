#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// Let K be the listed phases and g the gap. A point of the vacuum is in the gap between phases k and l if its
/// distances to them add up to less than g. The gap becomes part of the phase that is listed first. So phase k grows by
/// the points of the vacuum where
///
///     dₖ = (aₖ + min over l after k of aₗ − g)/2
///
/// is negative. The phases grow one by one, in the order of K, each below all materials that are already there, as in
/// unite_shape_below. All dₖ are computed from the original components, so filling one gap does not widen the next.
///
/// *I1*, every component is 1-Lipschitz: dₖ is half the sum of two 1-Lipschitz functions and a constant.
///
/// *I2*, φᵢ + φⱼ ≥ 0 for i ≠ j: let φ be the components before k grows, and φ' those afterwards. Only two components
/// change:
///
///     φ'ₖ = max(min(φₖ, dₖ), −m),  m = min over j ≠ 0, k of φⱼ,        φ'₀ = max(φ₀, −dₖ).
///
/// For a material j ≠ k, φ'ₖ + φⱼ ≥ −m + φⱼ ≥ 0 and φ'₀ + φⱼ ≥ φ₀ + φⱼ ≥ 0. The sum φ'ₖ + φ'₀ is at least φₖ + φ₀ ≥ 0
/// if φₖ ≤ dₖ, and otherwise at least dₖ − dₖ = 0.
///
/// *The smallest component is not positive.* Where m ≤ 0, another material has a component that is not positive. Where
/// m > 0, φ'ₖ ≤ 0 if φₖ ≤ 0 or dₖ ≤ 0. Otherwise φ₀ ≤ 0, because the smallest component was not positive, and −dₖ < 0,
/// so φ'₀ ≤ 0.
///
/// *Only the vacuum changes.* In a material j ≠ k, φ'ₖ ≥ −m > 0. In k, m is positive by I2, so φ'ₖ < 0. In the vacuum,
/// the label becomes k where dₖ < 0.
///
/// *No zeros remain in the gap.* Where the surface of k faces a filled gap, dₖ and −m are negative, so φ'ₖ is, too. The
/// surface of l stays where it is.
struct CloseGaps {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "close_gaps", "",
        "dₖ = (aₖ + min over l after k of aₗ − g)/2;  for each k in order, φₖ ← max(min(φₖ, dₖ), −min over j ≠ 0, k of "
        "φⱼ),  φ₀ ← max(φ₀, −dₖ)",
        "Fills thin gaps between phases, such as those between a glass and a liquid that was modelled a little too "
        "small. Vacuum becomes part of a phase where its distances to two phases add up to less than the gap. Combine "
        "the phases with over or under first, so that they no longer overlap."};
    Phased of{};
    std::vector<Phase> of_phases{};
    float gap = 0.001f;

    template <class V>
    static void parameters(V&& v) {
        v(&CloseGaps::of, Parameter{"of", "", "The object."});
        v(&CloseGaps::of_phases,
          Parameter{"phases", "",
                    "The phases between which gaps are closed, at least two. A gap becomes part of the phase listed "
                    "first."});
        v(&CloseGaps::gap,
          Parameter{"gap", "m",
                    "Gaps narrower than this are closed. Make it at least twice as wide as the gaps, because those in "
                    "corners are wider.",
                    limits::positive});
    }
    void prepare() const {
        if (of_phases.size() < 2) throw ModelError("close_gaps: \"phases\" must list at least two phases");
        const PhaseSet there = phasetree::phases(of);
        for (std::size_t i = 0; i < of_phases.size(); ++i) {
            const std::string which = "close_gaps: item " + std::to_string(i + 1) + " of \"phases\" ";
            if (!there.contains(of_phases[i])) throw ModelError(which + "is not a phase of the object");
            if (std::find(of_phases.begin(), of_phases.begin() + static_cast<std::ptrdiff_t>(i), of_phases[i]) !=
                of_phases.begin() + static_cast<std::ptrdiff_t>(i))
                throw ModelError(which + "is listed twice");
        }
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        if (!a.has(0)) return a;  // no vacuum: the object fills space, so there is no gap
        const auto gaps = distances_to_gaps(a);
        for (std::size_t k = 0; k < gaps.size(); ++k) {
            const int phase = of_phases[k].index;
            const auto others = *detail::minimum(a, a.materials() & ~PhaseSet::of(of_phases[k]).bits);
            // The operands of the inner minimum and of the last maximum are in this order because dₖ may be ∞ − ∞ far
            // away, and min(NaN, x) and max(NaN, x) are x.
            a.set(phase, max(min(gaps[k], a[phase]), -others));
            a.set(0, max(-gaps[k], a[0]));
        }
        return a;
    }
    PhaseSet phases() const { return phasetree::phases(of); }
    /// Where dₖ ≤ level, the smaller of the two distances is at most level + g/2.
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level + gap / 2); }

  private:
    /// The dₖ of all phases but the last.
    template <class S>
    std::vector<S> distances_to_gaps(const Phases<S>& a) const {
        std::vector<S> result(of_phases.size() - 1);
        S after = a[of_phases.back().index];
        for (std::size_t k = result.size(); k-- > 0;) {
            const S& distance = a[of_phases[k].index];
            result[k] = (distance + after - gap) * 0.5f;
            after = min(distance, after);
        }
        return result;
    }
};

}  // namespace phasetree
