// Images for textures: a colour for each place of a plane, on which the image is repeated without end.
//
// Pixels are linear Rec.709 in [0, 1], interpolated bilinearly between their centres. Files that store integers, such
// as PNG and JPEG, are taken to be sRGB-encoded and decoded before anything is interpolated, floating-point ones to be
// linear as they are; grey is grey. They are kept in sixteen bits a channel.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
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
    /// Width over height.
    float aspect() const { return static_cast<float>(width_) / static_cast<float>(height_); }

  private:
    glm::vec3 pixel(int column, int row) const;

    int width_, height_;
    std::vector<std::array<std::uint16_t, 3>> pixels_;
};

inline constexpr int largest_texture_image = 4096;
inline constexpr Parameter image_file_parameter{
    "file", "", "An image of any format that OpenImageIO reads, at most 4096 × 4096 pixels."};

/// Throws ParameterError of "file".
std::shared_ptr<const TextureImage> load_texture_image(const std::filesystem::path& file);

}  // namespace phasetree::tracer
