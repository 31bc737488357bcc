#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace phasetree::tracer {

/// Where a cropped image lies inside the whole picture, in pixels from the picture's top left corner.
/// EXR calls the crop the data window and the whole picture the display window.
struct Crop {
    int x0 = 0;
    int y0 = 0;
    int display_width = 0;
    int display_height = 0;
};

/// Linear Rec.709 radiance, row-major, the top row first.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
    std::optional<Crop> crop = std::nullopt;
};

/// The number of pixels with a NaN or an infinity in any channel.
std::size_t count_non_finite(const Image& image);

}  // namespace phasetree::tracer
