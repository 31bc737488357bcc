// Planes as people choose them, by their names.
#pragma once

#include <string>
#include <vector>

#include "film/planes.hpp"

namespace phasetree::tracer {

/// The planes of every film and those of these names; or all of them, of the one name "all". Throws
/// std::invalid_argument, whose message is for people, if there is no such plane.
Planes::Choice chosen_planes(const std::vector<std::string>& names);

}  // namespace phasetree::tracer
