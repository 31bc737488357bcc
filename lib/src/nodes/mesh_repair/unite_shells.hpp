#pragma once

#include <optional>
#include <span>
#include <string>

#include "model/preparation.hpp"
#include "nodes/mesh_repair/cells.hpp"
#include "nodes/mesh_repair/chain.hpp"

namespace phasetree::mesh {

/// The boundary of the points that the rule selects, of a closed chain, which is arranged for this. Throws ModelError
/// if its parts cannot be separated; `name` is the mesh's name in messages.
Chain arranged_boundary(Chain&, WindingRule, const std::string& name, model::Preparation&);

/// Whether the boxes of the shells overlap so often that uniting them two by two costs less than arranging all of them.
bool overlap_often(const Chain&, std::span<const std::uint32_t> shells);

/// The boundary of the points around which the closed chain winds at least once, if no shell winds around any point
/// negatively: the union of the solids within the shells. Returns nullopt for other chains.
///
/// Neighbouring shells are united first, two by two, then their unions, and so on. What has come to lie within a union
/// is removed at once. So the work grows with the size of the boundary. If all shells were arranged together, it would
/// grow with the number of places where any three of them cross, and so would the slivers between them, which make
/// arranging fail.
std::optional<Chain> union_of_shells(const Chain&, std::span<const std::uint32_t> shells, const std::string& name,
                                     model::Preparation&);

}  // namespace phasetree::mesh
