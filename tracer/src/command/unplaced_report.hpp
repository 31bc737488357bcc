#pragma once

#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

/// Which groups stand nowhere, and what therefore is not to be seen: a sentence with its place for each.
std::vector<std::string> warnings_of_unplaced_groups(const Document&, const PlacedObjects&);

/// Says them on standard error.
void warn_of_unplaced_groups(const Document&, const PlacedObjects&);

}  // namespace phasetree::tracer
