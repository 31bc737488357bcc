#pragma once

#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

struct Translate {
    static constexpr NodeInfo info{"translate", "6", "φ(p − v)", "Translates."};
    glm::vec3 by{0};

    struct Map {
        glm::vec3 by;
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            return p - by;
        }
        AffineMap affine() const { return {.before = by}; }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Translate::by, Parameter{"by", "m", "Image of the origin."});
    }
    Map map() const { return {by}; }
    float value_scale() const { return 1; }
    Bounds image(const Bounds& b) const { return b.empty() ? b : Bounds{b.low + by, b.high + by}; }
};

}  // namespace phasetree
