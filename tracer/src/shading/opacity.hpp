// How much of a mesh is there at each place, as leaves and fences are cut out of rectangles by an image.
#pragma once

#include <optional>

#include "shading/texture/number.hpp"

namespace phasetree::tracer {

struct Opacity {
    Number number = 1.0f;           ///< 0 is a hole; else the part of the rays that are stopped
    std::optional<float> cutoff{};  ///< then it is a hole below this number, and stops all rays from it on
    /// The part of the rays that are stopped at a place.
    float at(const TexturePoint& place) const {
        const float found = number_at(number, place);
        return cutoff ? static_cast<float>(found >= *cutoff) : found;
    }
};

}  // namespace phasetree::tracer
