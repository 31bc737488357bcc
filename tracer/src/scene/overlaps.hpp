// Where objects of a scene overlap, which they should not.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/placed.hpp"

namespace phasetree::tracer {

struct OverlappingCopy {
    std::uint32_t number = 0;  ///< of the copy
    std::uint32_t object = 0;
};

struct Overlap {
    OverlappingCopy first, second;  ///< by rising numbers
    glm::vec3 at{0};                ///< a point that is in both
};

struct Overlaps {
    std::vector<Overlap> found;  ///< at most a few, and fewer of each pair of objects
    bool has_more = false;       ///< whether other copies were not looked at because enough was found
    bool is_cut_short = false;   ///< whether not all pairs whose boxes meet could be looked at
};

/// Objects that touch do not overlap: they do where a ball of a ten-thousandth of the smaller one's size is in both.
/// Takes seconds at most, however many copies there are.
Overlaps find_overlaps(const PlacedObjects&);

}  // namespace phasetree::tracer
