#include "image/texture_image.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "image/read_image.hpp"
#include "image/srgb.hpp"

namespace phasetree::tracer {

namespace {

constexpr float most = 65535.0f;

std::uint16_t stored(float value) {
    // What is no number is black.
    return static_cast<std::uint16_t>(value > 0.0f ? std::min(value, 1.0f) * most + 0.5f : 0.0f);
}

int wrapped(int i, int count) {
    const int rest = i % count;
    return rest < 0 ? rest + count : rest;
}

}  // namespace

glm::vec3 TextureImage::pixel(int column, int row) const {
    const auto index = static_cast<std::size_t>(wrapped(row, height_)) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(wrapped(column, width_));
    const auto& p = pixels_[index];
    return glm::vec3(p[0], p[1], p[2]) / most;
}

glm::vec3 TextureImage::at(const glm::vec2& uv) const {
    // Within one repeat first, so that no number of repeats is too large for a pixel's number.
    const float x = (uv.x - std::floor(uv.x)) * static_cast<float>(width_) - 0.5f;
    const float y = (std::ceil(uv.y) - uv.y) * static_cast<float>(height_) - 0.5f;
    if (!std::isfinite(x) || !std::isfinite(y)) return pixel(0, 0);
    const float left = std::floor(x), top = std::floor(y);
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const glm::vec3 above = glm::mix(pixel(column, row), pixel(column + 1, row), x - left);
    const glm::vec3 below = glm::mix(pixel(column, row + 1), pixel(column + 1, row + 1), x - left);
    return glm::mix(above, below, y - top);
}

std::shared_ptr<const TextureImage> load_texture_image(const std::filesystem::path& file) {
    ImageHeader header;
    std::vector<std::array<std::uint16_t, 3>> pixels;
    const auto begin = [&](const ImageHeader& read) {
        if (read.width > largest_texture_image || read.height > largest_texture_image)
            throw std::runtime_error(fmt::format("it is larger than {0} × {0}", largest_texture_image));
        header = read;
        return header.channels < 3 ? 1 : 3;
    };
    try {
        read_image(file, "texture image", begin, [&](std::span<const float> values) {
            const auto linear = [&](float v) { return stored(header.is_floating_point ? v : linear_from_srgb(v)); };
            const std::size_t channels = header.channels < 3 ? 1 : 3;
            for (std::size_t i = 0; i + channels <= values.size(); i += channels) {
                const std::uint16_t first = linear(values[i]);
                if (channels == 1)
                    pixels.push_back({first, first, first});
                else
                    pixels.push_back({first, linear(values[i + 1]), linear(values[i + 2])});
            }
        });
    } catch (const std::runtime_error& e) {
        throw ParameterError("file", e.what());
    }
    return std::make_shared<const TextureImage>(header.width, header.height, std::move(pixels));
}

}  // namespace phasetree::tracer
