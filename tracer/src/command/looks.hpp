// What the phases of a scene look like in files for other programs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "page/look.hpp"
#include "phasetree/io/tree.hpp"

namespace phasetree::tracer {

// The looks of all phases, by their materials alone. A phase without a material gets a colour that tells it from the
// others.
std::vector<Look> looks_of(const PhaseNames&, std::span<const std::optional<Material>>, const Bounds&);

// The same if no phase has a material.
std::vector<Look> looks_without_materials(const PhaseNames&);

}  // namespace phasetree::tracer
