// The labels of a cube's corners determine how the interfaces in it are connected: in patches, each with its own
// vertex, as in dual marching cubes (Nielson, *Dual Marching Cubes*, IEEE Visualization 2004), here generalised to
// several labels. This keeps the two faces of a wall apart even if it is only about as thick as a cube.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "phasetree/model/phase.hpp"

namespace phasetree::meshing {

/// The labels of a cube's corners; corner i is at (i & 1, i >> 1 & 1, i >> 2 & 1) from the lowest.
using Corners = std::array<Phase, 8>;

inline glm::ivec3 offset_of_corner(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

/// The index, from 0 to 11, of the edge along an axis that begins at a corner with these coordinates. The coordinate
/// along the axis is 0.
constexpr int edge_number(int axis, const glm::ivec3& offset) {
    const int lower = axis == 0 ? offset.y : offset.x, higher = axis == 2 ? offset.y : offset.z;
    return 4 * axis + lower + 2 * higher;
}
/// The index of the edge between two adjacent corners.
constexpr int edge_between(int a, int b) {
    const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2, start = a & b;
    return edge_number(axis, {start & 1, start >> 1 & 1, start >> 2 & 1});
}

/// The corners of each side of a cube, in order around it.
inline constexpr int sides_of_cube[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};

/// Whether two phases alternate around a side: A, B, A, B.
inline bool take_turns(const Corners& corners, int side) {
    const auto at = [&](int i) { return corners[static_cast<std::size_t>(sides_of_cube[side][i])]; };
    return at(0) == at(2) && at(1) == at(3) && at(0) != at(1);
}

/// The labels of a cube's corners and, for each side around which two phases alternate, the phase that is joined across
/// the side (joined_sides.hpp).
struct CubeLabels {
    Corners corners{};
    std::array<Phase, 6> joined{};

    Phase at(int corner) const { return corners[static_cast<std::size_t>(corner)]; }
};

/// A wall across a side. It exists if two opposite corners have a phase that neither of the other two has. In addition,
/// the other two have different phases, or the wall's phase is the one that is joined across the side. Each of its two
/// faces cuts the two edges that lead to one of the other corners.
struct WallAcross {
    bool is_there = false;
    int first = 0;  ///< the first corner of the side, 0 or 1, outside the wall; the other one is first + 2
};
WallAcross wall_across(const CubeLabels&, int side);

/// Disjoint sets of connected edges.
class LinkedEdges {
  public:
    LinkedEdges() { first_.fill(none); }
    void add(int edge) {
        if (of(edge) == none) of(edge) = edge;
    }
    /// Joins the sets of two edges, which must have been added.
    void link(int a, int b) {
        const int low = std::min(of(a), of(b)), high = std::max(of(a), of(b));
        for (int& f : first_)
            if (f == high) f = low;
    }
    bool has(int edge) const { return first_[static_cast<std::size_t>(edge)] != none; }
    /// The lowest edge in an edge's set.
    int first(int edge) const { return first_[static_cast<std::size_t>(edge)]; }

  private:
    static constexpr int none = -1;
    int& of(int edge) { return first_[static_cast<std::size_t>(edge)]; }
    std::array<int, 12> first_{};
};

/// Finds the cut edges of a cube; is_cut(a, b) decides this from the phases at an edge's ends. Cut edges of one side
/// are linked to each other. If there is a wall across the side, only those cut by the same face of the wall are
/// linked.
template <class IsCut>
LinkedEdges cut_edges(const CubeLabels& labels, IsCut&& is_cut) {
    LinkedEdges edges;
    for (int side = 0; side < 6; ++side) {
        const WallAcross wall = wall_across(labels, side);
        int before = -1;
        for (int i = 0; i < 4; ++i) {
            // Around a side with a wall, start one corner before `first`: the first two edges are then those cut by one
            // face, and the last two those cut by the other.
            const int start = wall.is_there ? wall.first + 3 + i : i;
            const int a = sides_of_cube[side][start % 4], b = sides_of_cube[side][(start + 1) % 4];
            if (!is_cut(labels.at(a), labels.at(b))) continue;
            const int edge = edge_between(a, b);
            edges.add(edge);
            if (before >= 0 && !(wall.is_there && i == 2)) edges.link(before, edge);
            before = edge;
        }
    }
    return edges;
}

/// The edges between two phases, grouped into patches: a patch is a set of linked edges (cut_edges).
class CubePatches {
  public:
    explicit CubePatches(const CubeLabels&);

    int count() const { return count_; }
    /// The index of the patch of an edge between two phases.
    int patch(int edge) const { return static_cast<int>(patches_ >> (2 * edge) & 3); }

  private:
    std::uint32_t patches_ = 0;  // two bits per edge: each patch has at least three edges, so there are at most four
                                 // patches
    int count_ = 0;
};

}  // namespace phasetree::meshing
