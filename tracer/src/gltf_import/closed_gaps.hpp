// Which thin gaps between solids were meant to be contacts, and are closed by the node `close_gaps`.
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
    std::vector<std::size_t> materials;  ///< those whose gaps are closed; an earlier one fills the gap to a later one
    float gap = 0;                       ///< in metres: gaps narrower than this are closed
};

/// Gaps are closed if they lie between a liquid and something else and cover a tenth or more of a surface, such as
/// those along the wall of a glass. `matter` has an entry per solid. `order` lists the numbers of all solids, winners
/// of overlaps first. A liquid comes after what it touches, so it fills the gap. Air between solids, as in double
/// glazing, stays. Every gap narrower than twice the widest one found is closed, because gaps are wider in corners.
/// nullopt if there are none.
std::optional<ClosedGaps> closed_gaps(const std::vector<Solid>& solids, std::span<const Matter> matter,
                                      const std::vector<Contact>& contacts, std::span<const std::size_t> order);

}  // namespace phasetree::tracer::gltf_import
