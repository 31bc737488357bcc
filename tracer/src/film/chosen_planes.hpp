// Selection of planes by name.
#pragma once

#include <string>
#include <vector>

#include "film/planes.hpp"

namespace phasetree::tracer {

/// Returns the default planes plus those with these names, or all planes for the single name "all". Throws
/// std::invalid_argument, with a message for users, if there is no such plane.
Planes::Choice chosen_planes(const std::vector<std::string>& names);

}  // namespace phasetree::tracer
