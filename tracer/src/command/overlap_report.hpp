#pragma once

#include "phasetree/io/document.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

/// Warns on standard error about overlapping objects. Names a point and both objects for the first few pairs.
void warn_of_overlaps(const Document&, const PlacedObjects&);

}  // namespace phasetree::tracer
