// Groups of places that stand nowhere, so that what is in them is not seen: most often one forgot to name them.
#pragma once

#include <vector>

#include "scene/placed.hpp"

namespace phasetree::tracer {

/// A group that neither a place of the scene nor another group names.
struct UnplacedGroup {
    std::uint32_t group = 0;
    std::vector<std::uint32_t> lost;  ///< the objects in it, through all its groups, that stand nowhere in the scene
};

/// A group that only such groups name is not among them, because it stands as soon as they do.
struct UnplacedGroups {
    std::vector<UnplacedGroup> found;  ///< at most a few, in the order of the file
    std::size_t more = 0;              ///< than these
};

UnplacedGroups find_unplaced_groups(const PlacedObjects&);

}  // namespace phasetree::tracer
