#pragma once

#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// The result of close_holes.
struct ClosedHoles {
    std::size_t holes = 0;
    std::size_t sheets = 0;  ///< shells that were removed
};

/// Make the chain, which has these edges, closed: add triangles between the boundary edges of each shell, and append
/// their shell numbers to `shells`. Each loop of boundary edges is projected to the plane that fits it best, and cut
/// into triangles ear by ear.
///
/// A shell is a sheet if the added area exceeds the fraction `largest_patch` of its own area. A sheet hardly encloses
/// anything, and is removed.
ClosedHoles close_holes(Chain&, std::span<const EdgeOfChain> edges, std::vector<std::uint32_t>& shells);

inline constexpr double largest_patch = 0.8;

}  // namespace phasetree::mesh
