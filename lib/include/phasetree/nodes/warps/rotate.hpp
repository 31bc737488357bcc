#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

struct Rotate {
    static constexpr NodeInfo info{"rotate", "6", "φ(Rᵀ p)",
                                   "Rotates about an axis through the origin, by the right-hand rule."};
    glm::vec3 axis{0, 0, 1};
    float angle = 0;
    glm::mat3 matrix{1};  ///< R, derived

    struct Map {
        glm::vec3 column[3];
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            return {dot(p, column[0]), dot(p, column[1]), dot(p, column[2])};
        }
        AffineMap affine() const { return {.row = {column[0], column[1], column[2]}}; }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Rotate::axis, Parameter{"axis", "", "Direction of the axis; any length but zero.", limits::any, true});
        v(&Rotate::angle, Parameter{"angle", "degrees", "Angle."});
    }
    void prepare() {
        const glm::dvec3 direction(axis);
        if (!(glm::length(direction) > 0)) throw ModelError("rotate: the axis must not be zero");
        matrix =
            glm::mat3(glm::rotate(glm::dmat4(1), glm::radians(static_cast<double>(angle)), glm::normalize(direction)));
    }
    Map map() const { return {{matrix[0], matrix[1], matrix[2]}}; }
    float value_scale() const { return 1; }
    Bounds image(const Bounds& b) const { return image_of(b, matrix); }
};

}  // namespace phasetree
