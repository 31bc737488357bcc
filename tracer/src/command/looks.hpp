// What the phases of a scene look like in files for other programs.
#pragma once

#include <span>
#include <vector>

#include "page/look.hpp"
#include "phasetree/io/tree.hpp"

namespace phasetree::tracer {

// By their materials, of which there is one for each phase.
std::vector<Look> looks_of(const PhaseNames&, std::span<const Material>, const Bounds&);
// Of a tree alone: colours that differ.
std::vector<Look> looks_without_materials(const PhaseNames&);

}  // namespace phasetree::tracer
