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
    /// By how much it makes lengths longer at most: a bound, at most √3 times too large.
    double stretch() const {
        return glm::sqrt(glm::dot(matrix[0], matrix[0]) + glm::dot(matrix[1], matrix[1]) +
                         glm::dot(matrix[2], matrix[2]));
    }
    /// A box around the image of a box, rounded outward.
    Bounds image(const Bounds& box) const;
    /// Whether M is invertible by far, and all numbers are such as coordinates and lengths may be.
    bool is_usable() const;
};

}  // namespace phasetree::tracer
