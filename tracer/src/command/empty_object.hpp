// Objects of which nothing is left: cut away altogether, most often by mistake. They are no error, but worth a
// sentence.
#pragma once

#include <string>

#include "phasetree/cells/cells.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

// Whether the object is vacuum everywhere, as far as rays can tell. Quick unless it is empty, or very thin: then its
// cells are built to find out. Of an unbounded object nothing is known, so that it is not.
bool is_empty(const Phased& object, const Evaluator& evaluator);

// The sentence, at the document's tree.
std::string empty_object_warning(const Document&);

}  // namespace phasetree::tracer
