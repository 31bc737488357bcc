// Detection of overlapping objects, which are usually mistakes.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/placed.hpp"

namespace phasetree::tracer {

struct OverlappingCopy {
    std::uint32_t number = 0;  ///< number of the copy
    std::uint32_t object = 0;
};

struct Overlap {
    OverlappingCopy first, second;  ///< in increasing order of their numbers
    glm::vec3 at{0};                ///< a point in both
};

struct Overlaps {
    std::vector<Overlap> found;  ///< only a few, and fewer per pair of objects
    bool has_more = false;       ///< whether the search stopped because enough were found
    bool is_cut_short = false;   ///< whether the work limit prevented checking all pairs whose boxes overlap
};

/// Objects that merely touch do not overlap. Objects overlap if a ball with a radius of a ten-thousandth of the smaller
/// one's size is in both. Takes seconds at most, however many copies there are.
Overlaps find_overlaps(const PlacedObjects&);

}  // namespace phasetree::tracer
