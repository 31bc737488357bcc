#pragma once

#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// Which of a scene's phases are in none of its objects and named nowhere: a sentence with its place for each, because a
/// phase that was declared is meant to be somewhere. One that is named and not there was taken away, as a bore is.
std::vector<std::string> warnings_of_unused_phases(const Document&, const PhaseNames&, PhaseSet used);

/// Says them on standard error.
void warn_of_unused_phases(const Document&, const PhaseNames&, PhaseSet used);

}  // namespace phasetree::tracer
