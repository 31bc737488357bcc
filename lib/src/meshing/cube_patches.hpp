// The labels of a cube's corners tell how the interfaces in it are connected: in patches, each of which has a vertex of
// its own, as in dual marching cubes (Nielson, *Dual Marching Cubes*, IEEE Visualization 2004), here for several
// labels. So both faces of a wall that is about as thick as a cube are kept apart.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "phasetree/model/phase.hpp"

namespace phasetree::meshing {

/// The labels of a cube's corners: corner i is at (i & 1, i >> 1 & 1, i >> 2 & 1) from the lowest.
using Corners = std::array<Phase, 8>;

inline glm::ivec3 offset_of_corner(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

/// The number, from 0 to 11, of the edge along an axis that begins at a corner of these coordinates, of which that
/// along the axis is 0.
constexpr int edge_number(int axis, const glm::ivec3& offset) {
    const int lower = axis == 0 ? offset.y : offset.x, higher = axis == 2 ? offset.y : offset.z;
    return 4 * axis + lower + 2 * higher;
}
/// The number of the edge between two corners that are neighbours.
constexpr int edge_between(int a, int b) {
    const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2, start = a & b;
    return edge_number(axis, {start & 1, start >> 1 & 1, start >> 2 & 1});
}

/// The corners around each side of a cube, in their order around it.
inline constexpr int sides_of_cube[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};

/// Returns whether two phases take turns around a side: A, B, A, B.
inline bool take_turns(const Corners& corners, int side) {
    const auto at = [&](int i) { return corners[static_cast<std::size_t>(sides_of_cube[side][i])]; };
    return at(0) == at(2) && at(1) == at(3) && at(0) != at(1);
}

/// What is known of a cube: the labels of its corners, and for each side around which two phases take turns, the one of
/// them that is joined across the side (joined_sides.hpp).
struct CubeLabels {
    Corners corners{};
    std::array<Phase, 6> joined{};

    Phase at(int corner) const { return corners[static_cast<std::size_t>(corner)]; }
};

/// Around some sides two opposite corners have a phase that neither of the other two has, and that phase is joined
/// across the side. It is a wall there. Each of its two faces cuts the two edges that lead to one of the other corners.
struct WallAcross {
    bool is_there = false;
    int first = 0;  ///< the first corner of the side, 0 or 1, that is not of the wall; the other one is first + 2
};
WallAcross wall_across(const CubeLabels&, int side);

/// Sets of edges that are connected.
class LinkedEdges {
  public:
    LinkedEdges() { first_.fill(none); }
    void add(int edge) {
        if (of(edge) == none) of(edge) = edge;
    }
    /// Joins the sets of two edges that were added.
    void link(int a, int b) {
        const int low = std::min(of(a), of(b)), high = std::max(of(a), of(b));
        for (int& f : first_)
            if (f == high) f = low;
    }
    bool has(int edge) const { return first_[static_cast<std::size_t>(edge)] != none; }
    /// The lowest edge in the set of an edge.
    int first(int edge) const { return first_[static_cast<std::size_t>(edge)]; }

  private:
    static constexpr int none = -1;
    int& of(int edge) { return first_[static_cast<std::size_t>(edge)]; }
    std::array<int, 12> first_{};
};

/// Finds the edges of a cube that are cut, which is_cut(a, b) tells from the phases at their ends. Cut edges of one
/// side are linked to each other; where a wall is across the side, only those that one face of it cuts.
template <class IsCut>
LinkedEdges cut_edges(const CubeLabels& labels, IsCut&& is_cut) {
    LinkedEdges edges;
    for (int side = 0; side < 6; ++side) {
        const WallAcross wall = wall_across(labels, side);
        int before = -1;
        for (int i = 0; i < 4; ++i) {
            // Around a side with a wall the walk starts one corner before `first`: its first two edges are those that
            // one face cuts, and its last two those that the other face cuts.
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

/// The edges between two phases, sorted into patches: a patch is a set of linked edges (cut_edges).
class CubePatches {
  public:
    explicit CubePatches(const CubeLabels&);

    int count() const { return count_; }
    /// The number of the patch of an edge between two phases.
    int patch(int edge) const { return static_cast<int>(patches_ >> (2 * edge) & 3); }

  private:
    std::uint32_t patches_ = 0;  // two bits for each edge: a patch has three edges at least, so there are four at most
    int count_ = 0;
};

}  // namespace phasetree::meshing
