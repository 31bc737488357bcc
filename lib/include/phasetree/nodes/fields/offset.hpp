#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Offset {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"offset", "4.1", "f − t", "Inflates a field by t, or deflates it if t is negative."};
    Field of{};
    float amount = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&Offset::of, Parameter{"of", "", "The field."});
        v(&Offset::amount, Parameter{"distance", "m", "Distance by which the surface moves outwards."});
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return d.field(of, p) - amount;
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level + amount); }
};

}  // namespace phasetree
