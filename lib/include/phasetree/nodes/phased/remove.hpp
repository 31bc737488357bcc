#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

struct Remove {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"remove", "5.2", "φₖ absent,  φ₀ = min(a₀, aₖ)", "Replaces phases by vacuum."};
    Phased of{};
    PhaseSet gone{};

    template <class V>
    static void parameters(V&& v) {
        v(&Remove::of, Parameter{"of", "", "The object."});
        v(&Remove::gone, Parameter{"phases", "", "The phases to remove."});
    }
    void prepare() const {
        if (gone.contains(vacuum)) throw ModelError("remove: the vacuum cannot be removed");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        return detail::emptied(d.phases(of, p), gone.bits);
    }
    PhaseSet phases() const {
        const PhaseSet there = phasetree::phases(of);
        PhaseSet left{there.bits & ~gone.bits};
        return left == there ? left : left | PhaseSet::of(vacuum);
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
