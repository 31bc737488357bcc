#include "shading/texture/field.hpp"

#include <glm/common.hpp>

#include "shading/texture/ramp.hpp"
#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

namespace {

glm::vec3 mixed(const FieldTexture& texture, const TexturePoint& p, const Wavelengths* wavelengths) {
    const std::vector<TextureStop>& stops = *texture.ramp;
    const BetweenStops between = between_stops(std::span(stops), texture.value.at(p.position));
    const glm::vec3 below = color_at(stops[between.below].texture, p, wavelengths);
    if (!(between.part > 0.0f)) return below;
    return glm::mix(below, color_at(stops[between.above].texture, p, wavelengths), between.part);
}

}  // namespace

glm::vec3 FieldTexture::at(const TexturePoint& p) const {
    return mixed(*this, p, nullptr);
}

glm::vec3 FieldTexture::at(const TexturePoint& p, const Wavelengths& wavelengths) const {
    return mixed(*this, p, &wavelengths);
}

}  // namespace phasetree::tracer
