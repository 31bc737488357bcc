// Partial coverage of a mesh, such as leaves and fences cut out of rectangles by an image.
#pragma once

#include <optional>

#include "shading/texture/number.hpp"

namespace phasetree::tracer {

struct Opacity {
    Number number = 1.0f;           ///< share of rays that are stopped, 0 to 1
    std::optional<float> cutoff{};  ///< if set, opacity is 0 below it and 1 from it on
    /// The share of rays that are stopped at a point.
    float at(const TexturePoint& place) const {
        const float found = number_at(number, place);
        return cutoff ? static_cast<float>(found >= *cutoff) : found;
    }
};

}  // namespace phasetree::tracer
