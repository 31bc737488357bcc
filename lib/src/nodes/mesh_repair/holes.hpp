#pragma once

#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// What close_holes did.
struct ClosedHoles {
    std::size_t holes = 0;
    std::size_t sheets = 0;  ///< shells that were removed
};

/// Make the chain, which has these edges, closed: add triangles between the boundary edges of each shell, and their
/// numbers to `shells`. Their loops are cut into triangles as polygons in the plane that fits them best, ear by ear.
///
/// A shell is a sheet if that takes more than `largest_patch` of its own area. A sheet hardly encloses anything: it is
/// removed.
ClosedHoles close_holes(Chain&, std::span<const EdgeOfChain> edges, std::vector<std::uint32_t>& shells);

inline constexpr double largest_patch = 0.8;

}  // namespace phasetree::mesh
