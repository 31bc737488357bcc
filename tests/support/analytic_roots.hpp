#pragma once

/// The exact sequence of phases along a ray, for CSG of spheres, boxes, cylinders, cones and planes. It computes the
/// roots with every primitive's quadrics and planes in double, sorts them, and labels the midpoints between them by set
/// algebra.

#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree::tests::analytic {

using glm::dvec3;

/// Roots of a t² + 2 b t + c, without cancellation.
template <class Use>
void solve(double a, double b, double c, Use&& use) {
    const double disc = b * b - a * c;
    if (a == 0) {
        if (b != 0) use(-c / (2 * b));
        return;
    }
    if (disc < 0) return;
    const double q = -(b + std::copysign(std::sqrt(disc), b));
    if (q != 0) use(c / q);
    use(q / a);
}

/// A piece of the ray in one phase, from `start` to the start of the next piece.
struct Piece {
    double start;
    Phase phase;
    dvec3 normal{0};  ///< of the surface at the start
};

/// Throws std::logic_error for an object with other nodes.
std::vector<Piece> exact_pieces(const Phased& object, const dvec3& o, const dvec3& d, double length);

}  // namespace phasetree::tests::analytic
