#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

namespace detail {
/// A ∪₋ B: B replaces A where both are present. The "−min φ_B" of the paper (Galin et al.) is over the *other* phases
/// of B, and the vacuum is not one of them.
///
/// *I2*, φᵢ + φⱼ ≥ 0 for i ≠ j (lib/README.md), is preserved. Let i and j be materials. If aᵢ ≤ bᵢ and aⱼ ≤ bⱼ, then φᵢ
/// + φⱼ ≥ aᵢ + aⱼ ≥ 0. If bᵢ is the smaller, φᵢ ≥ bᵢ, and φⱼ ≥ −bᵢ because bᵢ is among the others of j; likewise for
/// bⱼ. If j is the vacuum, φᵢ + φ₀ ≥ aᵢ + a₀ or φᵢ + φ₀ ≥ bᵢ + b₀, depending on which of aᵢ and bᵢ is smaller.
///
/// *The smallest component is not positive.* If some material has bₖ ≤ 0, all other b are at least 0 by I2, so φₖ ≤ 0.
/// Otherwise b₀ ≤ 0 and the other b are not negative, so the component φₗ ≤ max(aₗ, 0) of the smallest a is not
/// positive.
template <class S>
Phases<S> under(const Phases<S>& a, const Phases<S>& b) {
    Phases<S> result;
    if (a.has(0) && b.has(0)) result.set(0, max(a[0], b[0]));
    minimum_of_others(b, b.materials(), a.materials() | b.materials(), [&](int i, const std::optional<S>& others) {
        const S both = *minimum_of(a, b, i);
        result.set(i, others ? max(both, -*others) : both);
    });
    return result;
}
inline PhaseSet united_phases(std::span<const Phased> of) {
    PhaseSet all, vacuum_everywhere{1};
    for (const Phased& child : of) {
        const PhaseSet there = phasetree::phases(child);
        all = all | PhaseSet{there.bits & ~std::uint64_t{1}};
        vacuum_everywhere = vacuum_everywhere & there;
    }
    return all | vacuum_everywhere;
}
inline constexpr Parameter objects{"of", "", "The objects, at least one."};
}  // namespace detail

struct Under {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"under", "4.3", "φᵢ = max(min(aᵢ, bᵢ), −min over j ≠ i of bⱼ),  φ₀ = max(a₀, b₀)",
                                   "Combines objects; where they overlap, later ones replace earlier ones. Applied "
                                   "pairwise, from the first object to the last."};
    std::vector<Phased> of{};

    template <class V>
    static void parameters(V&& v) {
        v(&Under::of, detail::objects);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        Phases<typename D::Scalar> result = d.phases(of.front(), p);
        for (std::size_t i = 1; i < of.size(); ++i) result = detail::under(result, d.phases(of[i], p));
        return result;
    }
    PhaseSet phases() const { return detail::united_phases(of); }
    Bounds bounds(BoundsQuery& q, float level) const {
        Bounds b;
        for (const Phased& child : of) b = unite(b, q(child, level));
        return b;
    }
};

}  // namespace phasetree
