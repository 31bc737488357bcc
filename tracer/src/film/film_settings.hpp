// The settings of a picture: its size, its pixel filter and its planes.
#pragma once

#include <glm/vec2.hpp>

#include "film/pixel_filter.hpp"
#include "film/pixel_range.hpp"
#include "film/planes.hpp"

namespace phasetree::tracer {

/// Settings of the whole picture, whatever part of it is rendered.
struct FilmSettings {
    int width = 1024;  ///< in pixels, at least 1
    int height = 768;  ///< in pixels, at least 1
    PixelFilter filter{};
    Planes::Choice planes = Planes::by_default();

    glm::ivec2 resolution() const { return {width, height}; }
    PixelRange whole() const { return {0, 0, width, height}; }
};

}  // namespace phasetree::tracer
