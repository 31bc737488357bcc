#pragma once

#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// Turn triangles so that any two that share an edge with no third face the same way, where that is possible. The
/// larger part, by area, keeps its orientation. The edges are those of the chain, and are turned with it.
void orient(Chain&, std::vector<EdgeOfChain>& edges);

/// For each triangle, the number of its shell. A shell is a set of triangles connected by edges.
std::vector<std::uint32_t> shells_of(const Chain&, std::span<const EdgeOfChain> edges);

/// Turn shells that are inside out. If that is most of the volume, turn all. Then, a shell that encloses a negative
/// volume is a cavity if it is within larger shells, and is turned otherwise. The chain must be closed.
void turn_shells(Chain&, std::span<const std::uint32_t> shells);

}  // namespace phasetree::mesh
