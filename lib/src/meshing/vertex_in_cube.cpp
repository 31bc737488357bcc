#include "meshing/vertex_in_cube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

namespace phasetree::meshing {

namespace {

// Directions whose eigenvalue is less than this fraction of the largest are ignored. So two faces count as a single
// bent one if their normals differ by less than 11°.
constexpr double least_eigenvalue = 0.01;

struct Eigen {
    std::array<double, 3> values{};
    std::array<glm::dvec3, 3> vectors{};
};

// The eigenvalues and eigenvectors of a symmetric matrix, by Jacobi rotations.
Eigen eigen_of(glm::dmat3 a) {
    glm::dmat3 v(1);
    const double small = 1e-16 * (a[0][0] + a[1][1] + a[2][2]);
    for (int sweep = 0; sweep < 12; ++sweep) {
        if (std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]) <= small) break;
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            if (std::abs(a[p][q]) <= 1e-3 * small) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1), s = t * c;
            glm::dmat3 turn(1);
            turn[p][p] = turn[q][q] = c;
            turn[q][p] = s;  // column q, row p
            turn[p][q] = -s;
            a = glm::transpose(turn) * a * turn;
            v = v * turn;
        }
    }
    return {{a[0][0], a[1][1], a[2][2]}, {v[0], v[1], v[2]}};
}

// How far outside the cube the vertex may be, in side lengths. With this limit, only few vertices that belong on an
// edge of the object miss it. With a larger one, vertices of neighbouring cubes pass each other where two faces meet at
// a small angle, and the triangles between them fold over.
constexpr double most_outside = 0.5;

// Returns b. If that is too far from the cube, returns the point where the segment from a, which is in the cube, to b
// leaves the cube.
glm::dvec3 kept_near_cube(const glm::dvec3& a, const glm::dvec3& b, double apart, bool is_alone) {
    double share = is_alone ? 1 : 1 - apart;
    const bool is_near = glm::clamp(b, -most_outside, 1 + most_outside) == b;
    for (int i = 0; i < 3; ++i) {
        const double way = b[i] - a[i];
        if (b[i] > 1) share = std::min(share, is_near ? 1 - apart : (1 - a[i]) / way);
        if (b[i] < 0) share = std::min(share, is_near ? 1 - apart : -a[i] / way);
    }
    return a + share * (b - a);
}

}  // namespace

glm::dvec3 vertex_in_cube(std::span<const PlaneInCube> planes, const glm::dvec3& mean, double apart, bool is_alone) {
    glm::dmat3 a(0);
    glm::dvec3 b(0);
    for (const PlaneInCube& p : planes) {
        a += glm::outerProduct(p.normal, p.normal);
        b += glm::dot(p.normal, p.point - mean) * p.normal;
    }
    const Eigen eigen = eigen_of(a);
    const double largest = std::max({eigen.values[0], eigen.values[1], eigen.values[2]});
    glm::dvec3 step(0);
    int directions = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(eigen.values[i] > least_eigenvalue * largest)) continue;
        step += glm::dot(eigen.vectors[i], b) / eigen.values[i] * eigen.vectors[i];
        ++directions;
    }
    if (directions == 1) step *= 0.5;
    return kept_near_cube(mean, mean + step, apart, is_alone);
}

}  // namespace phasetree::meshing
