// An affine map, in double precision so that rounding in chains of groups is negligible.
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
    /// Composition: applies the other map first, then this one.
    Transform operator*(const Transform& first) const { return {matrix * first.matrix, (*this)(first.by)}; }
    Transform inverse() const {
        const glm::dmat3 back = glm::inverse(matrix);
        return {back, -(back * by)};
    }
    /// An upper bound on the factor by which lengths grow. It is exact for a stretch along the axes that is followed by
    /// rotations, reflections and uniform scaling; otherwise it is at most 1.32 times too large. It is √‖MᵀM‖∞: the
    /// largest singular value of M is √‖MᵀM‖₂, and a symmetric matrix has ‖·‖₂ ≤ ‖·‖∞ ≤ √3 ‖·‖₂.
    double stretch() const {
        const glm::dmat3 squared = glm::transpose(matrix) * matrix;
        double most = 0;
        for (int i = 0; i < 3; ++i)
            most = glm::max(most, glm::abs(squared[i].x) + glm::abs(squared[i].y) + glm::abs(squared[i].z));
        return glm::sqrt(most);
    }
    /// A box around the image of a box, rounded outward.
    Bounds image(const Bounds& box) const;
    /// Whether M is well-conditioned, and all numbers are within the limits of coordinates and lengths.
    bool is_usable() const;
};

}  // namespace phasetree::tracer
