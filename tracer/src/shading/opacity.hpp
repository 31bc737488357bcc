// Partial coverage of a mesh, such as leaves and fences cut out of rectangles by an image.
#pragma once

#include <optional>

#include "shading/texture/number.hpp"

namespace phasetree::tracer {

struct Opacity {
    Number number = 1.0f;           ///< the part of the rays that are stopped, 0 to 1
    std::optional<float> cutoff{};  ///< below it no ray is stopped, and else all are
    bool by_vertices = false;       ///< whether the number is multiplied by the alpha of the vertices' colours
    /// The least of all places, if the vertices' alpha is 1.
    float least() const { return least_of(number); }
    /// The part of the rays that are stopped at a place.
    float at(const TexturePoint& place) const {
        float found = number_at(number, place);
        if (by_vertices && place.mesh) found *= place.mesh->alpha;
        return cutoff ? static_cast<float>(found >= *cutoff) : found;
    }
};

}  // namespace phasetree::tracer
