// Which thin gaps between clear objects were meant to be contacts, and are closed by the node `close_gaps`.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gltf_import/contacts.hpp"
#include "gltf_import/precedence.hpp"
#include "gltf_import/solids.hpp"

namespace phasetree::tracer::gltf_import {

/// The parameters of `close_gaps`.
struct ClosedGaps {
    /// The materials whose gaps are closed, in the reverse of `order` below: each one fills the gaps to those after it.
    std::vector<std::size_t> materials;
    float gap = 0;  ///< in metres: gaps narrower than this are closed
};

/// Gaps between a liquid and something else, such as those along the wall of a glass, are closed if they cover a tenth
/// or more of either surface. `matter` has an entry per object in `solids`. `order` lists the indices of all objects,
/// winners of overlaps first. A liquid loses overlaps, so it comes late in `order` and early in `materials`, and fills
/// the gap. Gaps between two objects that are not liquid, such as the air in double glazing, are not considered.
/// Between the chosen materials, every gap narrower than twice the widest one considered is closed, because gaps are
/// wider in corners. nullopt if there are none.
std::optional<ClosedGaps> closed_gaps(const std::vector<Solid>& solids, std::span<const Matter> matter,
                                      const std::vector<Contact>& contacts, std::span<const std::size_t> order);

}  // namespace phasetree::tracer::gltf_import
