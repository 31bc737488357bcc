#pragma once

#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// A sentence with its place for each of a scene's phases that is in none of its objects and named nowhere, and for
/// each of its shapes that is named nowhere, because what was declared is meant to be somewhere. A phase that is named
/// and not there was taken away, as a bore is.
std::vector<std::string> warnings_of_unused_names(const Document&, const PhaseNames&, PhaseSet used);

/// Says them on standard error.
void warn_of_unused_names(const Document&, const PhaseNames&, PhaseSet used);

}  // namespace phasetree::tracer
