// An image as the film gives it and as files hold it: a picture, and further channels beside it.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace phasetree::tracer {

/// Where a cropped image lies inside the whole picture, in pixels from the picture's top left corner. EXR calls the
/// crop the data window and the whole picture the display window.
struct Crop {
    int x0 = 0;
    int y0 = 0;
    int display_width = 0;
    int display_height = 0;
};

/// A value for each pixel, under a name as EXR has it: "depth.Z".
struct Channel {
    std::string name;
    std::vector<float> values;  ///< row by row as the pixels are
};

struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;  ///< linear Rec.709 radiance, row by row, the top row first
    std::optional<Crop> crop = std::nullopt;
    std::vector<Channel> further{};  ///< which only EXR files keep
    /// What the header of an EXR file says beside all else: names and texts.
    std::vector<std::pair<std::string, std::string>> attributes{};
};

/// A part of an image, of pixels from its own top left corner.
Image part_of(const Image& image, int x0, int y0, int width, int height);

/// The number of pixels with a NaN or an infinity in any channel.
std::size_t count_non_finite(const Image& image);

}  // namespace phasetree::tracer
