#pragma once

#include "phasetree/nodes/phased/shape_cut.hpp"

namespace phasetree {

/// The minimum over all pairs of max(aᵢ, aⱼ) is the second smallest component, found in one pass. As in the paper
/// (Galin et al.), the vacuum is not part of any pair: the surface of the object is not one of its interfaces.
struct Interfaces {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"interfaces", "7.4",
                                   "S = (second smallest of a₁ … aₙ) − ε,  φᵢ = max(aᵢ, S),  φ₀ = min(a₀, −S)",
                                   "Thin volumes about all interfaces between phases."};
    Phased of{};
    float half_thickness = 0.05f;

    template <class V>
    static void parameters(V&& v) {
        v(&Interfaces::of, Parameter{"of", "", "The object, with at least two phases."});
        v(&Interfaces::half_thickness, Parameter{"half_thickness", "m", "Depth ε in each phase.", limits::positive});
    }
    void prepare() const {
        if (PhaseSet{phasetree::phases(of).bits & ~std::uint64_t{1}}.size() < 2)
            throw ModelError("interfaces: the object must have at least two phases");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto a = d.phases(of, p);
        std::optional<typename D::Scalar> first, second;
        for_each_phase(a.materials(), [&](int i) {
            if (first) {
                const auto later = max(*first, a[i]);
                second = second ? min(*second, later) : later;
            }
            first = first ? min(*first, a[i]) : a[i];
        });
        return detail::cut(a, *second - half_thickness, {});
    }
    PhaseSet phases() const { return phasetree::phases(of) | PhaseSet::of(vacuum); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
