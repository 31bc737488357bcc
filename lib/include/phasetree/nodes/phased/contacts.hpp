#pragma once

#include "phasetree/nodes/phased/contact.hpp"

namespace phasetree {

/// A_K is the union of the phases K of A. a_K = −min aₖ over all phases not in K, including the vacuum: the depth in
/// the union as a whole. (The minimum over K of aₖ would be zero on the interfaces within it.) By I2 (φᵢ + φⱼ ≥ 0 for i
/// ≠ j), it is at most aₖ for each k ∈ K. In contrast, `contact` uses the depth in a single phase, which its neighbours
/// make shallow.
struct Contacts {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "contacts", "4.4",
        "f = α a_K − (1 − α) b_L,  a_K = −min over k ∉ K of aₖ,  b_L likewise,  bⱼ ← max(bⱼ, −f) for j ∈ L,  then A ∪₋ "
        "B",
        "Contact between sets of phases: objects that press against each other and keep their phases."};
    Phased a{};
    PhaseSet phases_a{};
    Phased b{};
    PhaseSet phases_b{};
    float alpha = 0.5f;

    template <class V>
    static void parameters(V&& v) {
        v(&Contacts::a, detail::contact_a);
        v(&Contacts::phases_a,
          Parameter{"phases_a", "", "The phases of A in contact; by default all.", limits::any, true});
        v(&Contacts::b, detail::contact_b);
        v(&Contacts::phases_b,
          Parameter{"phases_b", "", "The phases of B in contact; by default all.", limits::any, true});
        v(&Contacts::alpha, detail::contact_alpha);
    }
    void prepare() const {
        if (chosen(a, phases_a).empty()) throw ModelError("contacts: \"a\" contains none of \"phases_a\"");
        if (chosen(b, phases_b).empty()) throw ModelError("contacts: \"b\" contains none of \"phases_b\"");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto first = d.phases(a, p), second = d.phases(b, p);
        const PhaseSet k = chosen(a, phases_a), l = chosen(b, phases_b);
        return detail::contact(first, depth(first, k), second, depth(second, l), l, alpha);
    }
    PhaseSet phases() const { return detail::united_phases(std::array{a, b}); }
    Bounds bounds(BoundsQuery& q, float level) const { return unite(q(a, level), q(b, level)); }

  private:
    template <class S>
    static S depth(const Phases<S>& object, PhaseSet among) {
        const auto rest = detail::minimum(object, ~among.bits);
        return rest ? -*rest : *detail::minimum(object, among.bits);
    }
    static PhaseSet chosen(const Phased& object, PhaseSet among) {
        const std::uint64_t materials = phasetree::phases(object).bits & ~std::uint64_t{1};
        return {among.empty() ? materials : materials & among.bits};
    }
};

}  // namespace phasetree
