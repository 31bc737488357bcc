// A ramp that makes a colour, or another texture, of a number. Two textures are mixed in linear light.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "phasetree/io/kind.hpp"
#include "shading/texture/texture_point.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// The texture from this value on, until the next; texture.hpp has the member that is left out here.
struct TextureStop;
using TextureRamp = std::shared_ptr<const std::vector<TextureStop>>;

/// A list of stops, [[value, colour or number], …], of which the values rise.
struct RampParameter : Parameter {};

/// The ramp's colour for a value, at a place, as color_at() has it.
glm::vec3 color_at(const TextureRamp& ramp, float value, const TexturePoint& p, const Wavelengths* wavelengths);

}  // namespace phasetree::tracer
