#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// The affine map p ↦ A (p − before) − after, where A has the given rows. It is evaluated in this order. Subtracting
/// zero and multiplying by the unit matrix are exact. So two maps in which some steps do nothing can often be merged
/// without changing values: see then().
struct AffineMap {
    glm::vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    glm::vec3 before{0}, after{0};

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        const Vec3<T> q = p - before;
        return Vec3<T>{dot(q, row[0]), dot(q, row[1]), dot(q, row[2])} - after;
    }

    /// The inverse map, p ↦ M p + v.
    struct Inverse {
        glm::dmat3 matrix;
        glm::dvec3 by;  ///< v
    };
    Inverse inverse() const {
        const glm::dmat3 m = glm::inverse(glm::transpose(glm::dmat3(row[0], row[1], row[2])));
        return {m, m * glm::dvec3(after) + glm::dvec3(before)};
    }

    bool moves_before() const { return before != glm::vec3(0); }
    bool moves_after() const { return after != glm::vec3(0); }
    bool turns() const {
        return row[0] != glm::vec3(1, 0, 0) || row[1] != glm::vec3(0, 1, 0) || row[2] != glm::vec3(0, 0, 1);
    }
    /// Compose this map with `next`, which is applied after it. Returns nullopt if no single map gives the same values
    /// to the last bit (except for the sign of a zero).
    std::optional<AffineMap> then(const AffineMap& next) const {
        if (!turns() && !moves_after() && !(moves_before() && next.moves_before()))
            return AffineMap{
                {next.row[0], next.row[1], next.row[2]}, moves_before() ? before : next.before, next.after};
        if (!moves_after() && !next.turns() && !(next.moves_before() && next.moves_after()))
            return AffineMap{{row[0], row[1], row[2]}, before, next.moves_before() ? next.before : next.after};
        return std::nullopt;
    }
};

}  // namespace phasetree
