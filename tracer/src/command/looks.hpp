// Colours and materials of phases for files read by other programs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "page/look.hpp"
#include "phasetree/io/tree.hpp"

namespace phasetree::tracer {

// The looks of all phases, derived from their materials alone. A phase without a material gets a distinct colour.
std::vector<Look> looks_of(const PhaseNames&, std::span<const std::optional<Material>>, const Bounds&);

// The looks if no phase has a material.
std::vector<Look> looks_without_materials(const PhaseNames&);

}  // namespace phasetree::tracer
