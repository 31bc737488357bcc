#include "shading/texture/field.hpp"

#include <glm/common.hpp>

#include "shading/texture/ramp.hpp"
#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

glm::vec3 FieldTexture::at(const TexturePoint& p) const {
    const std::vector<TextureStop>& stops = *ramp;
    const BetweenStops between = between_stops(std::span(stops), value.at(p.position));
    const glm::vec3 below = color_at(stops[between.below].texture, p);
    return between.part > 0.0f ? glm::mix(below, color_at(stops[between.above].texture, p), between.part) : below;
}

}  // namespace phasetree::tracer
