#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "nodes/mesh_tree_view.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree::mesh {

/// Calls f with the corners of each face of a mesh (PieceTree) whose leaf's box meets the given one. Stops once f
/// returns false.
template <class F>
void for_each_face_near(const float* tree, const Bounds& box, F&& f) {
    const TreeView view(tree);
    // From the root down; nodes are in depth-first order, and a balanced tree of 2³² faces has fewer levels.
    std::array<std::size_t, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::size_t index = stack[--depth];
        const float* node = view.node(index);
        const auto is_apart = [&](int axis) {
            return node[PieceTree::low + static_cast<std::size_t>(axis)] > box.high[axis] ||
                   node[PieceTree::high + static_cast<std::size_t>(axis)] < box.low[axis];
        };
        if (is_apart(0) || is_apart(1) || is_apart(2)) continue;
        if (const auto second = static_cast<std::size_t>(node[PieceTree::second_child]); second != 0) {
            stack[depth++] = second;
            stack[depth++] = index + 1;
            continue;
        }
        constexpr std::size_t first_face = PieceTree::first + 2 * static_cast<std::size_t>(PieceKind::face);
        const auto first = static_cast<std::size_t>(node[first_face]);
        const auto end = first + static_cast<std::size_t>(node[first_face + 1]);
        for (std::size_t face = first; face < end; ++face) {
            const auto corner = [&](std::size_t i) {
                const float* p = view.corner(face, i);
                return glm::vec3(p[0], p[1], p[2]);
            };
            if (!f(std::array<glm::vec3, 3>{corner(0), corner(1), corner(2)})) return;
        }
    }
}

}  // namespace phasetree::mesh
