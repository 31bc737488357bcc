// Requirements on a texture, which gives a colour for every point of a surface. texture.hpp lists all kinds.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>

#include "shading/texture/texture_point.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// * at(p): the reflectance at p in linear Rec.709, each channel in [0, 1]. p is a position in object space, in the
///   scene's unit of length, for a solid texture, and a TexturePoint for others. Coordinates are below 10⁹ in
///   magnitude.
///
/// A texture with more information on a colour than red, green and blue also has
/// * at(p, wavelengths): the reflectance at a path's wavelengths. For other textures, a spectrum of the same colour is
///   used.
template <class T>
concept TextureKind = std::copyable<T> &&(
    requires(const T& texture, const glm::vec3& p) {
        { texture.at(p) } -> std::same_as<glm::vec3>;
    } ||
    requires(const T& texture, const TexturePoint& p) {
        { texture.at(p) } -> std::same_as<glm::vec3>;
    });

}  // namespace phasetree::tracer
