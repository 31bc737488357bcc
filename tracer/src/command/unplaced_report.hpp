#pragma once

#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

/// A warning with its location for each group that is never placed, listing what is therefore invisible.
std::vector<std::string> warnings_of_unplaced_groups(const Document&, const PlacedObjects&);

/// Prints these warnings to standard error.
void warn_of_unplaced_groups(const Document&, const PlacedObjects&);

}  // namespace phasetree::tracer
