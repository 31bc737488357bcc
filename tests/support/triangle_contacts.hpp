// Finds where the triangles of a mesh cross or touch each other outside common vertices and edges. Pairs are found by a
// sweep; whether two triangles touch is decided by meshing/triangle_contact.hpp, which has tests of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "meshing/triangle_contact.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree::tests {

struct TriangleContacts {
    std::size_t pairs = 0;    ///< of triangles that cross or touch
    std::size_t slivers = 0;  ///< triangles that are hardly more than a line or a point

    std::size_t all() const { return pairs + slivers; }
};

/// The precision of the farthest coordinate. Rounding all coordinates once more moves vertices by less than that.
inline double last_place(std::span<const glm::vec3> vertices) {
    float farthest = 0;
    for (const glm::vec3& v : vertices) farthest = std::max({farthest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return 0x1p-23 * static_cast<double>(farthest);
}

/// Things touch if they are closer than `tolerance`.
inline TriangleContacts triangle_contacts(std::span<const glm::vec3> vertices,
                                          std::span<const std::array<std::uint32_t, 3>> triangles, double tolerance) {
    const auto margin = static_cast<float>(tolerance);
    std::vector<Bounds> boxes;
    for (const auto& t : triangles) {
        Bounds box;
        for (const std::uint32_t v : t) box = unite(box, {vertices[v] - margin, vertices[v] + margin});
        boxes.push_back(box);
    }
    const auto placed = [&](std::uint32_t i) {
        meshing::PlacedTriangle t{triangles[i], {}};
        for (std::size_t k = 0; k < 3; ++k) t.at[k] = glm::dvec3(vertices[t.vertices[k]]);
        return t;
    };
    // In the order of x, each with those that begin before it and end behind its beginning.
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(boxes[i].low.x, i); });
    meshing::TriangleContact contact(tolerance);
    TriangleContacts found;
    std::vector<std::uint32_t> open;
    for (const std::uint32_t i : order) {
        std::erase_if(open, [&](std::uint32_t k) { return boxes[k].high.x < boxes[i].low.x; });
        for (const std::uint32_t k : open)
            if (!intersect(boxes[i], boxes[k]).empty() && contact.between(placed(i), placed(k))) ++found.pairs;
        if (contact.within(placed(i))) ++found.slivers;
        open.push_back(i);
    }
    return found;
}

}  // namespace phasetree::tests
