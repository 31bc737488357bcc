#pragma once

#include <array>

#include "phasetree/nodes/fields/mesh_tree.hpp"

namespace phasetree::mesh {

/// The locations of a tree's pieces and nodes among its floats, and of the corners that follow them: for each face, the
/// numbers of its three vertices, counterclockwise seen from outside.
struct TreeView {
    std::array<const float*, piece_kinds> pieces;
    const float* nodes;
    const float* corners;

    explicit TreeView(const float* data) {
        const float* at = data + PieceList::head;
        for_each_kind([&]<class Kind>() {
            pieces[static_cast<std::size_t>(Kind::kind)] = at;
            at += PieceList::count(data, Kind::kind) * Kind::floats;
        });
        nodes = at + 1;
        corners = nodes + static_cast<std::size_t>(*at) * PieceTree::node_floats;
    }
    const float* node(std::size_t i) const { return nodes + i * PieceTree::node_floats; }
    /// The position of a corner of a face, as three floats.
    const float* corner(std::size_t face, std::size_t i) const {
        const auto vertex = static_cast<std::size_t>(corners[3 * face + i]);
        return pieces[static_cast<std::size_t>(PieceKind::vertex)] + vertex * Vertex::floats + Vertex::position;
    }
};

}  // namespace phasetree::mesh
