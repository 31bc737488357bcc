#pragma once

#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// A warning with its location for each declared phase that is in no object and never referenced, and for each declared
/// shape that is never referenced. A phase that is referenced but absent from the result was presumably removed on
/// purpose, like the material of a drilled hole.
std::vector<std::string> warnings_of_unused_names(const Document&, const PhaseNames&, PhaseSet used);

/// Prints these warnings to standard error.
void warn_of_unused_names(const Document&, const PhaseNames&, PhaseSet used);

}  // namespace phasetree::tracer
