// Groups that are never placed, so that their content is invisible. Usually a reference to them was forgotten.
#pragma once

#include <vector>

#include "scene/placed.hpp"

namespace phasetree::tracer {

/// A group that neither an instance of the scene nor another group refers to.
struct UnplacedGroup {
    std::uint32_t group = 0;
    std::vector<std::uint32_t> lost;  ///< its objects, through all its groups, that are placed nowhere in the scene
};

/// Groups that are used only by such groups are not listed, because placing the latter places them, too.
struct UnplacedGroups {
    std::vector<UnplacedGroup> found;  ///< only a few, in the order of the file
    std::size_t more = 0;              ///< number of further ones
};

UnplacedGroups find_unplaced_groups(const PlacedObjects&);

}  // namespace phasetree::tracer
