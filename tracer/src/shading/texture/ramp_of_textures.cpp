#include "shading/texture/ramp_of_textures.hpp"

#include <glm/common.hpp>

#include "shading/texture/ramp.hpp"
#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

glm::vec3 color_at(const TextureRamp& ramp, float value, const TexturePoint& p, const Wavelengths* wavelengths) {
    const std::vector<TextureStop>& stops = *ramp;
    const BetweenStops between = between_stops(std::span(stops), value);
    const glm::vec3 below = color_at(stops[between.below].texture, p, wavelengths);
    if (!(between.part > 0.0f)) return below;
    return glm::mix(below, color_at(stops[between.above].texture, p, wavelengths), between.part);
}

}  // namespace phasetree::tracer
