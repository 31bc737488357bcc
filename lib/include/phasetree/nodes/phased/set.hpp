#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Set {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"set", "4.1", "φₖ = f,  φ₀ = −f", "Fills a field with one phase."};
    Phase phase{1};
    Field of{};

    template <class V>
    static void parameters(V&& v) {
        v(&Set::phase, Parameter{"phase", "", "The phase inside."});
        v(&Set::of, Parameter{"of", "", "The field."});
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto f = d.field(of, p);
        Phases<typename D::Scalar> result;
        result.set(0, -f);
        result.set(phase.index, f);
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(vacuum) | PhaseSet::of(phase); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
