#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "phasetree/math/spectral.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The Jacobian J of the inverse warp ω⁻¹ (warped.hpp) is M⁻¹ everywhere, and λ is its spectral norm: the square root
/// of the largest eigenvalue of M⁻ᵀM⁻¹.
struct Affine {
    static constexpr NodeInfo info{"affine", "6", "φ(M⁻¹(p − v))/λ,  M = (x y z),  λ = ‖M⁻¹‖₂",
                                   "Maps the unit vectors to any three vectors that span space, and the origin to a "
                                   "point: shears, stretches, rotates and mirrors."};
    glm::vec3 x{1, 0, 0};
    glm::vec3 y{0, 1, 0};
    glm::vec3 z{0, 0, 1};
    glm::vec3 by{0};
    glm::mat3 inverse{1};  ///< derived
    float scale = 1;       ///< 1/λ, derived

    struct Map {
        glm::vec3 by;
        glm::vec3 row[3];
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            const Vec3<T> q = p - by;
            return {dot(q, row[0]), dot(q, row[1]), dot(q, row[2])};
        }
        AffineMap affine() const { return {.row = {row[0], row[1], row[2]}, .before = by}; }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Affine::x, Parameter{"x", "", "Image of the vector [1, 0, 0].", limits::any, true});
        v(&Affine::y, Parameter{"y", "", "Image of the vector [0, 1, 0].", limits::any, true});
        v(&Affine::z, Parameter{"z", "", "Image of the vector [0, 0, 1].", limits::any, true});
        v(&Affine::by, Parameter{"by", "m", "Image of the origin.", limits::any, true});
    }
    void prepare() {
        const glm::dmat3 m{glm::dvec3(x), glm::dvec3(y), glm::dvec3(z)};
        const double volume = std::abs(glm::determinant(m));
        const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
        if (!(volume > 1e-6 * lengths) || !(lengths > 1e-24) || !(lengths < 1e24))
            throw ModelError("affine: \"x\", \"y\" and \"z\" do not span space");
        const glm::dmat3 back = glm::inverse(m);
        const glm::dmat3 g = glm::transpose(back) * back;
        std::vector<double> entries;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) entries.push_back(g[i][j]);
        // Squares of the entries, and their products with lengths, must be finite floats.
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (!(std::abs(back[i][j]) < 1e18))
                    throw ModelError("affine: \"x\", \"y\" and \"z\" are too small, or too different in length");
        inverse = glm::mat3(back);
        scale = static_cast<float>((1 - 2e-7) / std::sqrt(largest_eigenvalue(std::move(entries), 3)));
    }
    Map map() const {
        const glm::mat3 t = glm::transpose(inverse);
        return {by, {t[0], t[1], t[2]}};
    }
    float value_scale() const { return scale; }
    Bounds image(const Bounds& b) const {
        if (b.empty()) return b;
        const Bounds turned = image_of(b, glm::mat3(x, y, z));
        return Bounds{turned.low + by, turned.high + by}.inflated(1e-6f * glm::length(by));
    }
};

}  // namespace phasetree
