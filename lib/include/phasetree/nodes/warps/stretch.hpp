#pragma once

#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The Jacobian J of the inverse warp ω⁻¹ (warped.hpp) is diag(1/s). Its norm is 1 over the smallest factor,
/// everywhere.
struct Stretch {
    static constexpr NodeInfo info{"stretch", "6", "φ(x/sx, y/sy, z/sz) · min(sx, sy, sz)",
                                   "Scales by a different factor along each axis."};
    glm::vec3 factors{1};

    struct Map {
        glm::vec3 inverse;
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            return {p.x * inverse.x, p.y * inverse.y, p.z * inverse.z};
        }
        AffineMap affine() const { return {.row = {{inverse.x, 0, 0}, {0, inverse.y, 0}, {0, 0, inverse.z}}}; }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Stretch::factors, Parameter{"factors", "", "The factors along x, y and z.", limits::positive});
    }
    void prepare() const {
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(1.f / factors[i])) throw ModelError("stretch: a factor is too small");
    }
    Map map() const { return {1.f / factors}; }
    float value_scale() const { return std::min({factors.x, factors.y, factors.z}); }
    Bounds image(const Bounds& b) const { return b.empty() ? b : Bounds{b.low * factors, b.high * factors}; }
};

}  // namespace phasetree
