// What a texture must provide: a colour at every place of a surface. texture.hpp has the list of all kinds.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>

#include "shading/texture/texture_point.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// * at(p): the reflectance at p in linear Rec.709, each channel in [0, 1]. p is a position in the object's own space,
///   in the scene's unit of length, for a solid texture, and a TexturePoint for others. Coordinates are below 10⁹ in
///   magnitude.
///
/// A texture that knows more of a colour than red, green and blue also has
/// * at(p, wavelengths): the reflectance at a path's wavelengths. Of other textures a colour is taken that looks alike.
template <class T>
concept TextureKind = std::copyable<T> &&(
    requires(const T& texture, const glm::vec3& p) {
        { texture.at(p) } -> std::same_as<glm::vec3>;
    } ||
    requires(const T& texture, const TexturePoint& p) {
        { texture.at(p) } -> std::same_as<glm::vec3>;
    });

}  // namespace phasetree::tracer
