#pragma once

#include "phasetree/nodes/phased/shape_cut.hpp"

namespace phasetree {

/// All phases but i and j are replaced by vacuum, and these two are cut to the set S of points within ε of both.
///
/// I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): φᵢ + φ₀ ≥ min(aᵢ + a₀, aᵢ + aₖ, S − S).
struct Interface {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "interface", "7.4",
        "S = max(aᵢ, aⱼ) − ε,  φᵢ = max(aᵢ, S),  φⱼ = max(aⱼ, S),  φ₀ = min(a₀, −S, min over k ≠ i, j of aₖ)",
        "A thin volume about the interface between two phases, equally deep in both."};
    Phased of{};
    Phase phase_a{1};
    Phase phase_b{2};
    float half_thickness = 0.05f;

    template <class V>
    static void parameters(V&& v) {
        v(&Interface::of, Parameter{"of", "", "The object."});
        v(&Interface::phase_a, Parameter{"phase_a", "", "The phase on one side."});
        v(&Interface::phase_b, Parameter{"phase_b", "", "The phase on the other side."});
        v(&Interface::half_thickness, Parameter{"half_thickness", "m", "Depth ε in each phase.", limits::positive});
    }
    void prepare() const {
        if (phase_a == phase_b) throw ModelError("interface: a phase has no interface with itself");
        const PhaseSet there = phasetree::phases(of);
        if (!there.contains(phase_a)) throw ModelError("interface: the object does not contain \"phase_a\"");
        if (!there.contains(phase_b)) throw ModelError("interface: the object does not contain \"phase_b\"");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto a = d.phases(of, p);
        Phases<typename D::Scalar> pair;
        pair.set(phase_a.index, a[phase_a.index]);
        pair.set(phase_b.index, a[phase_b.index]);
        if (const auto outside = detail::minimum(a, ~pair.present)) pair.set(0, *outside);
        return detail::cut(pair, max(a[phase_a.index], a[phase_b.index]) - half_thickness, {});
    }
    PhaseSet phases() const { return PhaseSet::of(vacuum) | PhaseSet::of(phase_a) | PhaseSet::of(phase_b); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
