// Images for textures: a colour at each point of a plane, over which the image repeats endlessly.
//
// Pixels are linear Rec.709 in [0, 1], interpolated bilinearly between their centres. Integer formats such as PNG and
// JPEG are assumed to be sRGB-encoded, and are decoded before interpolation. Floating-point formats are assumed to be
// linear. Greyscale images stay grey. Pixels are stored in sixteen bits per channel. Images of numbers rather than
// colours, such as roughness or alpha, are used as stored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class TextureImage {
  public:
    /// `pixels` has width × height elements, in rows from the top.
    TextureImage(int width, int height, std::vector<std::array<std::uint16_t, 3>> pixels)
        : width_(width), height_(height), pixels_(std::move(pixels)) {}

    /// The colour at a point. (0, 0) is the lower left corner, (1, 1) the upper right one.
    glm::vec3 at(const glm::vec2& uv) const;
    /// The minimum and maximum of a channel (0 to 2) over all pixels.
    glm::vec2 range(int channel) const;
    /// The mean of all pixels.
    glm::vec3 mean() const;
    /// The fraction of pixels whose channel is at least this value.
    float share_above(float value) const;
    std::size_t pixels() const { return pixels_.size(); }
    /// Width over height.
    float aspect() const { return static_cast<float>(width_) / static_cast<float>(height_); }

  private:
    using Pixel = std::array<std::uint16_t, 3>;

    static glm::vec3 decoded(const Pixel&);
    glm::vec3 pixel(int column, int row) const;

    int width_, height_;
    std::vector<std::array<std::uint16_t, 3>> pixels_;
};

inline constexpr int largest_texture_image = 4096;
inline constexpr Parameter image_file_parameter{
    "file", "", "Image file in any format that OpenImageIO reads, at most 4096 × 4096 pixels."};
inline constexpr Parameter repeat_parameter{
    "repeat", "", "Number of repetitions of the image, horizontally and vertically.", limits::any, true};

/// How to interpret an image's integers; floating-point values are used directly.
enum class ImageMeaning {
    colors,
    numbers,
    alpha,  ///< the alpha channel, in all three channels of the result; an image without one is rejected
};

/// Throws ParameterError for "file".
std::shared_ptr<const TextureImage> load_texture_image(const std::filesystem::path& file,
                                                       ImageMeaning meaning = ImageMeaning::colors);

/// Loads an image embedded in another file (read_image_in_memory). Throws std::runtime_error.
TextureImage texture_image_in_memory(std::string_view bytes, const std::string& name, ImageMeaning meaning);

}  // namespace phasetree::tracer
