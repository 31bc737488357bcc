#pragma once

#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

struct Scale {
    static constexpr NodeInfo info{"scale", "6", "s · φ(p / s)", "Scales by the same factor along all axes."};
    float factor = 1;

    struct Map {
        float inverse;
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            return p * inverse;
        }
        AffineMap affine() const { return {.row = {{inverse, 0, 0}, {0, inverse, 0}, {0, 0, inverse}}}; }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Scale::factor, Parameter{"factor", "", "The factor.", limits::positive});
    }
    void prepare() const {
        if (!std::isfinite(1.f / factor)) throw ModelError("scale: the factor is too small");
    }
    Map map() const { return {1.f / factor}; }
    float value_scale() const { return factor; }
    Bounds image(const Bounds& b) const { return b.empty() ? b : Bounds{b.low * factor, b.high * factor}; }
};

}  // namespace phasetree
