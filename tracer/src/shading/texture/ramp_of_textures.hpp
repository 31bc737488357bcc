// A ramp from numbers to colours or other textures. Two textures are mixed in linear light.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "phasetree/io/kind.hpp"
#include "shading/texture/texture_point.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// The texture from this value up to the next stop. Defined in texture.hpp because it contains a texture.
struct TextureStop;
using TextureRamp = std::shared_ptr<const std::vector<TextureStop>>;

/// A list of stops, [[value, colour or number], …], with increasing values.
struct RampParameter : Parameter {};

/// The ramp's colour for a value, at a point; see color_at() of a texture.
glm::vec3 color_at(const TextureRamp& ramp, float value, const TexturePoint& p, const Wavelengths* wavelengths);

}  // namespace phasetree::tracer
