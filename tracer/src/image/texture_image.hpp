// Images for textures: a colour for each place of a plane, on which the image is repeated without end.
//
// Pixels are linear Rec.709 in [0, 1], interpolated bilinearly between their centres. Files that store integers, such
// as PNG and JPEG, are taken to be sRGB-encoded and decoded before anything is interpolated, floating-point ones to be
// linear as they are; grey is grey. They are kept in sixteen bits a channel. Images of numbers that are no colours,
// such as a roughness or the alpha beside colours, are taken as they are stored.
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
    /// Rows from the top; `pixels` has width × height of them.
    TextureImage(int width, int height, std::vector<std::array<std::uint16_t, 3>> pixels)
        : width_(width), height_(height), pixels_(std::move(pixels)) {}

    /// (0, 0) is the lower left corner, (1, 1) the upper right one.
    glm::vec3 at(const glm::vec2& uv) const;
    /// The least and the greatest value of a channel, 0 to 2, in all pixels.
    glm::vec2 range(int channel) const;
    /// The mean of all pixels.
    glm::vec3 mean() const;
    /// The part of all pixels that have a channel of at least this value.
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
    "file", "", "An image of any format that OpenImageIO reads, at most 4096 × 4096 pixels."};
inline constexpr Parameter repeat_parameter{
    "repeat", "", "How often the image stands side by side, and one above the other.", limits::any, true};

/// What an image's integers mean; floating-point numbers mean themselves.
enum class ImageMeaning {
    colors,
    numbers,
    alpha,  ///< the alpha beside the colours, as numbers in all three channels; an image without is rejected
};

/// Throws ParameterError of "file".
std::shared_ptr<const TextureImage> load_texture_image(const std::filesystem::path& file,
                                                       ImageMeaning meaning = ImageMeaning::colors);

/// An image that is part of another file (read_image_in_memory). Throws std::runtime_error.
TextureImage texture_image_in_memory(std::string_view bytes, const std::string& name, ImageMeaning meaning);

}  // namespace phasetree::tracer
