#pragma once

#include "phasetree/io/document.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

/// Says on standard error which groups stand nowhere, and what therefore is not to be seen.
void warn_of_unplaced_groups(const Document&, const PlacedObjects&);

}  // namespace phasetree::tracer
