#pragma once

#include "phasetree/io/document.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

/// Says on standard error where objects overlap: of the first few pairs that do, a point and both objects.
void warn_of_overlaps(const Document&, const PlacedObjects&);

}  // namespace phasetree::tracer
