// Detection of empty objects, from which everything has been cut away, usually by mistake. They cause a warning, not an
// error.
#pragma once

#include <string>

#include "phasetree/cells/cells.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

// Whether the object is vacuum everywhere, as far as rays can tell. Fast unless the object is empty or very thin,
// because only then are its cells built to find out. Returns false for an unbounded object, about which nothing is
// known.
bool is_empty(const Phased& object, const Evaluator& evaluator);

// The warning, located at the document's tree.
std::string empty_object_warning(const Document&);

}  // namespace phasetree::tracer
