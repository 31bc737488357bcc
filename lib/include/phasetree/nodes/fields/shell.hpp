#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Shell {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"shell", "4.1", "|f| − t", "A wall of thickness 2t about a field's surface."};
    Field of{};
    float half_thickness = 0.05f;

    template <class V>
    static void parameters(V&& v) {
        v(&Shell::of, Parameter{"of", "", "The field."});
        v(&Shell::half_thickness,
          Parameter{"half_thickness", "m", "Half of the wall's thickness, t.", limits::positive});
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return abs(d.field(of, p)) - half_thickness;
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level + half_thickness); }
};

}  // namespace phasetree
