#pragma once

#include "phasetree/nodes/phased/under.hpp"

namespace phasetree {

namespace detail {
/// Two objects pressed against each other. Let K be some of the phases of A, and A_K the union of these phases;
/// likewise B_L for phases L of B. The result is A ∪₋ B (B replaces A where both are present, under.hpp), except in the
/// overlap of A_K and B_L, which the two share: B_L loses A_K ∩ {f < 0} to A,
///
///     f = α a_K − (1 − α) b_L,    a_K < 0 within A_K,  b_L < 0 within B_L,  b_L ≤ bⱼ for j in L.
///
/// So the result is A ∪₋ B with b'ⱼ = max(bⱼ, −f) instead of bⱼ for j ∈ L. Within A_K ∩ B_L, the sign of f decides. In
/// B_L outside A_K, both terms of −f are negative, so B keeps that part. Outside Bⱼ, b'ⱼ ≥ bⱼ > 0. φ₀ = max(a₀, b₀),
/// because the part that B loses is within A.
///
/// *I1*, every component is 1-Lipschitz: f is a convex combination of a_K and −b_L.
///
/// *I2*, φᵢ + φⱼ ≥ 0 for i ≠ j (lib/README.md): b' ≥ b, so b' satisfies it as B does. The result then satisfies it by
/// the proof in under.hpp.
///
/// For two objects with one phase each, the result is max(aᵢ, f) and max(bⱼ, −f): ∪₋ gives φᵢ = max(aᵢ, min(−bⱼ, f)),
/// and f = aᵢ − (1 − α)(aᵢ + bⱼ) = −bⱼ + α(aᵢ + bⱼ). Where aᵢ + bⱼ ≥ 0, both −bⱼ and f are at most aᵢ, so max(aᵢ,
/// min(−bⱼ, f)) and max(aᵢ, f) are both aᵢ. Elsewhere f ≤ −bⱼ, so min(−bⱼ, f) = f.
template <class S>
Phases<S> contact(const Phases<S>& a, const S& a_k, const Phases<S>& b, const S& b_l, PhaseSet l, float alpha) {
    const S f = a_k * alpha - b_l * (1.f - alpha);
    Phases<S> retreated = b;
    // −f comes first: where distances overflow, f is ∞ − ∞, which is NaN, and max(NaN, x) is x.
    for_each_phase(b.present & l.bits, [&](int j) { retreated.set(j, max(-f, b[j])); });
    return under(a, retreated);
}
inline constexpr Parameter contact_a{"a", "", "The object A."};
inline constexpr Parameter contact_b{"b", "",
                                     "The object B, which replaces A where they overlap without being in contact."};
inline constexpr Parameter contact_alpha{
    "alpha", "", "Where in the overlap they meet: 0 gives it all to B, 1 to A; at 1/2 both are equally deep in it.",
    limits::fraction};
}  // namespace detail

/// The paper (Galin et al., Section 4.4) has φᵢ = max(aᵢ, −f) and φⱼ = max(bⱼ, f), which would leave most of A ∪ B
/// empty. Here the signs of f are reversed. For α → 0, f tends to −bⱼ, and B gets the whole overlap.
///
/// Everything outside the contact is as in A ∪₋ B: the other phases of A and B remain, and those of B replace those of
/// A.
struct Contact {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"contact", "4.4",
                                   "f = α aᵢ − (1 − α) bⱼ,  φᵢ = max(aᵢ, f),  φⱼ = max(bⱼ, −f),  φ₀ = max(a₀, b₀)",
                                   "Two phases pressed against each other: they share the overlap."};
    Phased a{};
    Phase phase_a{1};
    Phased b{};
    Phase phase_b{2};
    float alpha = 0.5f;

    template <class V>
    static void parameters(V&& v) {
        v(&Contact::a, detail::contact_a);
        v(&Contact::phase_a, Parameter{"phase_a", "", "The phase of A that is in contact."});
        v(&Contact::b, detail::contact_b);
        v(&Contact::phase_b, Parameter{"phase_b", "", "The phase of B that is in contact."});
        v(&Contact::alpha, detail::contact_alpha);
    }
    void prepare() const {
        if (phase_a == phase_b) throw ModelError("contact: a phase cannot be in contact with itself");
        if (!phasetree::phases(a).contains(phase_a)) throw ModelError("contact: \"a\" does not contain \"phase_a\"");
        if (!phasetree::phases(b).contains(phase_b)) throw ModelError("contact: \"b\" does not contain \"phase_b\"");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto first = d.phases(a, p), second = d.phases(b, p);
        return detail::contact(first, first[phase_a.index], second, second[phase_b.index], PhaseSet::of(phase_b),
                               alpha);
    }
    PhaseSet phases() const { return detail::united_phases(std::array{a, b}); }
    Bounds bounds(BoundsQuery& q, float level) const { return unite(q(a, level), q(b, level)); }
};

}  // namespace phasetree
