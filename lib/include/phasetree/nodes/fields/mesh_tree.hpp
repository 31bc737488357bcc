#pragma once

#include <optional>
#include <span>
#include <vector>

#include "phasetree/math/point_range.hpp"
#include "phasetree/nodes/fields/mesh_pieces.hpp"

namespace phasetree::mesh {

/// A piece and its kind; null if the search found none, which happens only where coordinates are infinite.
struct FoundPiece {
    const float* piece = nullptr;
    PieceKind kind{};
};

/// All pieces of a mesh with a hierarchy of boxes: a PieceList, followed by the number of nodes; the nodes, each parent
/// before its children; and for each face, the numbers of its three vertices.
struct PieceTree {
    /// Layout of a node: its box; the index of its second child, or 0 for a leaf (the first child follows the node);
    /// and for each kind of piece, the first one in the leaf and their number.
    static constexpr std::size_t low = 0, high = 3, second_child = 6, first = 7, node_floats = 13;

    /// The nearest piece; the first of equally near ones. Distances are compared as the floats that the pieces return,
    /// so the result is the piece that a loop over all of them would find.
    static FoundPiece nearest(const float* data, const Vec3<float>& p);

    /// Append the PieceList of all pieces that can be nearest to any point of the box. Returns false if there are more
    /// than `most`. The pieces are taken from the tree, or from the list `around` of an enclosing box unless that is
    /// empty.
    static bool pieces_in(const float* tree, const PointRange& box, std::span<const float> around, std::size_t most,
                          std::vector<float>& floats);
};

/// The signed distance from a point to the piece found for it.
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
