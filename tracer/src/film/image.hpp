// An image, as made by the film and stored in files: a picture and extra channels.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace phasetree::tracer {

/// The position of a cropped image inside the whole picture, in pixels from the picture's top left corner. In EXR, the
/// crop is the data window and the whole picture the display window.
struct Crop {
    int x0 = 0;
    int y0 = 0;
    int display_width = 0;
    int display_height = 0;
};

/// A value for each pixel, with an EXR channel name such as "depth.Z".
struct Channel {
    std::string name;
    std::vector<float> values;  ///< row by row, like the pixels
};

struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;  ///< linear Rec.709 radiance, row by row, the top row first
    std::optional<Crop> crop = std::nullopt;
    std::vector<Channel> extra_channels{};  ///< stored only in EXR files, except for "A" (output/encode.hpp)
    /// Additional attributes of an EXR header: names and texts.
    std::vector<std::pair<std::string, std::string>> attributes{};
};

/// A part of an image, in pixels from its own top left corner.
Image part_of(const Image& image, int x0, int y0, int width, int height);

/// The number of pixels with a NaN or an infinity in any channel.
std::size_t count_non_finite(const Image& image);

}  // namespace phasetree::tracer
