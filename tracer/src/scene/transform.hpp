// An affine map of space, in double precision so that chains of groups add no rounding to speak of.
#pragma once

#include <glm/glm.hpp>

#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

/// p ↦ M p + v.
struct Transform {
    glm::dmat3 matrix{1};
    glm::dvec3 by{0};

    bool operator==(const Transform&) const = default;
    glm::dvec3 operator()(const glm::dvec3& p) const { return matrix * p + by; }
    /// First the other, then this one.
    Transform operator*(const Transform& first) const { return {matrix * first.matrix, (*this)(first.by)}; }
    Transform inverse() const {
        const glm::dmat3 back = glm::inverse(matrix);
        return {back, -(back * by)};
    }
    /// By how much it makes lengths longer at most: a bound, which is exact for turns, mirrorings, scales, and a
    /// stretch along the axes before them, and else at most 1.32 times too large. It is √‖MᵀM‖∞: the greatest singular
    /// value of M is √‖MᵀM‖₂, and of a symmetric matrix ‖·‖₂ ≤ ‖·‖∞ ≤ √3 ‖·‖₂.
    double stretch() const {
        const glm::dmat3 squared = glm::transpose(matrix) * matrix;
        double most = 0;
        for (int i = 0; i < 3; ++i)
            most = glm::max(most, glm::abs(squared[i].x) + glm::abs(squared[i].y) + glm::abs(squared[i].z));
        return glm::sqrt(most);
    }
    /// A box around the image of a box, rounded outward.
    Bounds image(const Bounds& box) const;
    /// Whether M is invertible by far, and all numbers are such as coordinates and lengths may be.
    bool is_usable() const;
};

}  // namespace phasetree::tracer
