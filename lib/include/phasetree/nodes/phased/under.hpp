#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

namespace detail {
/// A ∪₋ B: B replaces A where both are. The printed "−min φ_B" is over the *other* phases of B, and vacuum is not one
/// of them.
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
                                   "Objects together; where several are, a later one replaces the earlier. Folded "
                                   "from the first object to the last."};
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
