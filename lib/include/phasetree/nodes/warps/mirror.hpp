#pragma once

#include <glm/matrix.hpp>

#include "phasetree/math/unit_vector.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The part with p·n < 0 is replaced by the image of the other half. The map folds space along the plane: it is
/// continuous, and an isometry on either side, so λ = 1.
struct Mirror {
    static constexpr NodeInfo info{
        "mirror", "6", "φ(p − 2 min(p·n, 0) n)",
        "Mirrors at a plane through the origin: keeps the half to which the normal points, and adds its mirror image."};
    glm::vec3 normal{1, 0, 0};

    struct Map {
        glm::vec3 normal;
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            const T twice = min(dot(p, normal), T(0.f)) * 2.f;
            return {p.x - twice * normal.x, p.y - twice * normal.y, p.z - twice * normal.z};
        }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Mirror::normal, Parameter{"normal", "",
                                     "Direction that points into the half that is kept; any length but "
                                     "zero.",
                                     limits::any, true});
    }
    void prepare() {
        if (normal == glm::vec3(0)) throw ModelError("mirror: the normal must not be zero");
        normal = unit_vector(normal);
    }
    Map map() const { return {normal}; }
    float value_scale() const { return 1; }
    Bounds image(const Bounds& b) const {
        return unite(b, image_of(b, glm::mat3(1) - 2.f * glm::outerProduct(normal, normal)));
    }
    /// Returns the direction along which the child's support equals the mirrored object's support along d. Of a kept
    /// point and its image, the one on d's side of the plane is farther along d. So the direction is d or the mirror
    /// image of d, whichever points into the kept half.
    glm::dvec3 towards(const glm::dvec3& d) const {
        const glm::dvec3 n(normal);
        return d - 2 * std::min(glm::dot(d, n), 0.0) * n;
    }
    double beyond(const glm::dvec3&) const { return 0; }
};

}  // namespace phasetree
