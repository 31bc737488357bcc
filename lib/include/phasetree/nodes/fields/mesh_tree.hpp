#pragma once

#include <optional>
#include <span>
#include <vector>

#include "phasetree/math/point_range.hpp"
#include "phasetree/nodes/fields/mesh_pieces.hpp"

namespace phasetree::mesh {

/// A piece and its kind; null if a search has found none, which it does not where coordinates are infinite.
struct FoundPiece {
    const float* piece = nullptr;
    PieceKind kind{};
};

/// All pieces of a mesh with a hierarchy of boxes: a PieceList, behind it the number of nodes, and the nodes, each
/// parent before its children.
struct PieceTree {
    /// A node: its box, the number of its second child, which is 0 for a leaf (the first child follows the node), and
    /// for each kind of pieces the first that is in a leaf and how many are.
    static constexpr std::size_t low = 0, high = 3, second_child = 6, first = 7, node_floats = 13;

    /// The nearest piece, of equally near ones the first. Distances are compared as the pieces tell them in floats, so
    /// it is the piece that a loop over all of them would find.
    static FoundPiece nearest(const float* data, const Vec3<float>& p);

    /// Appends the PieceList of all pieces that can be nearest to any point of the box, or returns false if they are
    /// more than `most`. They are sought in the tree, or, if `around` is not empty, in that list of a box around.
    static bool pieces_in(const float* tree, const PointRange& box, std::span<const float> around, std::size_t most,
                          std::vector<float>& floats);
};

/// The signed distance from a point to the piece that a search has found for it.
template <class T>
T distance_to(const FoundPiece& found, const float* box, const Vec3<T>& p) {
    Told<T> told{T(nowhere), T(farthest)};
    if (found.piece)
        for_each_kind([&]<class Kind>() {
            if (found.kind == Kind::kind) told = Kind::tell(found.piece, p);
        });
    const bool is_face = !found.piece || found.kind == PieceKind::face;
    return is_face ? signed_distance(told, true, box, p) : signed_distance(told, false, box, p);
}

}  // namespace phasetree::mesh
