#pragma once

#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// Turn triangles so that, where possible, two of them face the same way if they share an edge with no third one. The
/// larger part, by area, keeps its orientation. The edges are those of the chain, and are turned with it.
void orient(Chain&, std::vector<EdgeOfChain>& edges);

/// For each triangle, the number of its shell. A shell is a set of triangles connected by edges.
std::vector<std::uint32_t> shells_of(const Chain&, std::span<const EdgeOfChain> edges);

/// Turn shells that are inside out. If most of the volume is inside out, turn all shells first. Then a shell that
/// encloses a negative volume is left as a cavity if it lies within larger shells, and turned otherwise. The chain must
/// be closed.
void turn_shells(Chain&, std::span<const std::uint32_t> shells);

}  // namespace phasetree::mesh
