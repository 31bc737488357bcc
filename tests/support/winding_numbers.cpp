#include "support/winding_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

// Compiled once for each instruction set. The bits are the same, because nothing is contracted.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PHASETREE_EACH_INSTRUCTION_SET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PHASETREE_EACH_INSTRUCTION_SET
#endif

namespace phasetree::tests {

namespace {

constexpr std::size_t lanes = 8;
using Lanes = std::array<double, lanes>;

// A vertex as seen from each of the points.
struct Seen {
    Lanes x, y, z, length;
};

struct Product {
    Lanes real, imaginary, turns;
};

// Multiplies by the complex number whose argument is half of the solid angle of a triangle.
inline __attribute__((always_inline)) void multiply(Product& product, const Seen& a, const Seen& b, const Seen& c) {
    for (std::size_t i = 0; i < lanes; ++i) {
        const double determinant = a.x[i] * (b.y[i] * c.z[i] - b.z[i] * c.y[i]) +
                                   a.y[i] * (b.z[i] * c.x[i] - b.x[i] * c.z[i]) +
                                   a.z[i] * (b.x[i] * c.y[i] - b.y[i] * c.x[i]);
        const double ab = a.x[i] * b.x[i] + a.y[i] * b.y[i] + a.z[i] * b.z[i],
                     bc = b.x[i] * c.x[i] + b.y[i] * c.y[i] + b.z[i] * c.z[i],
                     ca = c.x[i] * a.x[i] + c.y[i] * a.y[i] + c.z[i] * a.z[i];
        const double denominator =
            a.length[i] * b.length[i] * c.length[i] + ab * c.length[i] + bc * a.length[i] + ca * b.length[i];
        const double real = product.real[i] * denominator - product.imaginary[i] * determinant,
                     imaginary = product.real[i] * determinant + product.imaginary[i] * denominator;
        // Two arguments of one sign whose sum has the other one: the sum has passed π or −π.
        const double before = product.imaginary[i];
        const bool both_up = (before >= 0) & (determinant >= 0), both_down = (before < 0) & (determinant < 0);
        product.turns[i] += (both_up & (imaginary < 0)) ? 1.0 : 0.0;
        product.turns[i] -= (both_down & (imaginary >= 0)) ? 1.0 : 0.0;
        product.real[i] = real;
        product.imaginary[i] = imaginary;
    }
}

// Keeps the product from overflowing and underflowing.
inline __attribute__((always_inline)) void rescale(Product& product) {
    for (std::size_t i = 0; i < lanes; ++i) {
        const double scale = 1 / (std::abs(product.real[i]) + std::abs(product.imaginary[i]) + 1e-300);
        product.real[i] *= scale;
        product.imaginary[i] *= scale;
    }
}

PHASETREE_EACH_INSTRUCTION_SET Product product_of(const std::vector<glm::uvec3>& triangles,
                                                  const std::vector<Seen>& seen) {
    Product product{};
    product.real.fill(1);
    std::size_t factors = 0;
    for (const glm::uvec3& t : triangles) {
        multiply(product, seen[t.x], seen[t.y], seen[t.z]);
        if (++factors % 8 == 0) rescale(product);
    }
    return product;
}

void look(const TriangleMesh& mesh, const std::array<glm::dvec3, lanes>& points, double scale,
          std::vector<Seen>& seen) {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        for (std::size_t i = 0; i < lanes; ++i) {
            const glm::dvec3 p = (glm::dvec3(mesh.vertices[v]) - points[i]) * scale;
            seen[v].x[i] = p.x;
            seen[v].y[i] = p.y;
            seen[v].z[i] = p.z;
            seen[v].length[i] = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        }
}

}  // namespace

std::vector<double> winding_numbers(const TriangleMesh& mesh, std::span<const glm::vec3> points) {
    std::vector<double> result(points.size());
    // About the size of the mesh is 1, so products of eight factors neither overflow nor underflow.
    double size = 1e-300;
    for (const glm::vec3& v : mesh.vertices)
        for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(static_cast<double>(v[i] - mesh.vertices[0][i])));
    std::vector<Seen> seen(mesh.vertices.size());
    for (std::size_t first = 0; first < points.size(); first += lanes) {
        std::array<glm::dvec3, lanes> block;
        for (std::size_t i = 0; i < lanes; ++i) block[i] = points[std::min(first + i, points.size() - 1)];
        look(mesh, block, 1 / size, seen);
        const Product product = product_of(mesh.triangles, seen);
        for (std::size_t i = 0; i < lanes && first + i < points.size(); ++i)
            result[first + i] =
                std::atan2(product.imaginary[i], product.real[i]) / (2 * std::numbers::pi) + product.turns[i];
    }
    return result;
}

}  // namespace phasetree::tests
