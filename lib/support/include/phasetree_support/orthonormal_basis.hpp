#pragma once

#include <cmath>

namespace phasetree::support {

/// Two unit vectors perpendicular to a unit normal and to each other; a function of the normal alone (Duff, Burgess,
/// Christensen, Hery, Kensler, Liani and Villemin, "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017).
/// `Vector` is glm::vec3 or glm::dvec3.
template <class Vector>
struct OrthonormalBasis {
    Vector tangent, bitangent;

    explicit OrthonormalBasis(const Vector& normal) {
        using Number = typename Vector::value_type;
        const Number sign = std::copysign(Number(1), normal.z);
        const Number a = -1 / (sign + normal.z);
        const Number b = normal.x * normal.y * a;
        tangent = {1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
        bitangent = {b, sign + normal.y * normal.y * a, -normal.y};
    }
};

}  // namespace phasetree::support
