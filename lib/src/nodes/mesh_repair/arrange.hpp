#pragma once

#include <string>

#include "model/preparation.hpp"
#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// Split triangles until no two of them cross or touch outside their shared vertices and edges, and add up those that
/// have become equal. Afterwards corners are in ascending order.
///
/// In each round, edges and triangles are divided where they touch others. An edge is divided in all its triangles at
/// once, so a closed chain stays closed. Because new vertices are rounded to the lattice, parts may touch again; they
/// are then divided in the next round.
///
/// Slivers about as thin as the lattice spacing can touch again and again. So this stops after some rounds, and returns
/// the triangles that still touch others, usually none. If it has to keep slivers, it returns a sample of all
/// triangles, too, because their winding numbers have to be confirmed. Throws ModelError if the work exceeds a node's
/// budget; `name` is the mesh's name in messages. The result does not depend on the number of threads.
std::vector<std::uint32_t> arrange(Chain&, const std::string& name, model::Preparation&);

}  // namespace phasetree::mesh
