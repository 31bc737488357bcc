// How much of a mesh is there at each place, as leaves and fences are cut out of rectangles by an image.
#pragma once

#include <optional>

#include "shading/texture/number.hpp"

namespace phasetree::tracer {

struct Opacity {
    Number number = 1.0f;           ///< the part of the rays that are stopped, 0 to 1
    std::optional<float> cutoff{};  ///< below it no ray is stopped, and else all are
    /// The part of the rays that are stopped at a place.
    float at(const TexturePoint& place) const {
        const float found = number_at(number, place);
        return cutoff ? static_cast<float>(found >= *cutoff) : found;
    }
};

}  // namespace phasetree::tracer
