#include "lights/load_environment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <utility>
#include <vector>

#include "image/read_image.hpp"
#include "image/srgb.hpp"

namespace phasetree::tracer {

namespace {

void check(const ImageHeader& header) {
    constexpr std::int64_t most_pixels = std::int64_t{1} << 27;  // 16,384 × 8,192
    // Resizing may leave a difference of one pixel; a larger one means another projection, such as a cube map or an
    // angular map.
    if (std::abs(header.width / 2 - header.height) > 1)
        throw std::runtime_error("an environment map must be twice as wide as high, but this one has " +
                                 std::to_string(header.width) + " × " + std::to_string(header.height));
    if (static_cast<std::int64_t>(header.width) * header.height > most_pixels)
        throw std::runtime_error("it is larger than 16384 × 8192");
}

float largest_of(const glm::vec3& pixel) {
    return std::max({pixel.x, pixel.y, pixel.z});
}

}  // namespace

std::shared_ptr<const EnvironmentImage> load_environment_image(const std::string& path) {
    ImageHeader header;
    std::vector<glm::vec3> pixels;
    const auto begin = [&](const ImageHeader& read) {
        check(read);
        header = read;
        // Reserved memory is not committed until it is written.
        pixels.reserve(static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height));
        return header.channels < 3 ? 1 : 3;
    };
    read_image(path, "environment image", begin, [&](std::span<const float> values) {
        const auto linear = [&](float v) { return header.is_floating_point ? v : linear_from_srgb(v); };
        if (header.channels < 3)
            for (const float v : values) pixels.emplace_back(linear(v));
        else
            for (std::size_t i = 0; i < values.size(); i += 3)
                pixels.emplace_back(linear(values[i]), linear(values[i + 1]), linear(values[i + 2]));
    });
    const auto brightest = std::ranges::max_element(pixels, {}, largest_of);
    const float largest = largest_of(*brightest);
    const auto index = brightest - pixels.begin();
    try {
        return std::make_shared<const EnvironmentImage>(header.width, header.height, std::move(pixels));
    } catch (const std::invalid_argument&) {
        throw std::runtime_error(fmt::format(
            "cannot use the environment image \"{}\": its radiance adds up to more than a float can hold; its largest "
            "value is {:.3g}, at column {}, row {} (counted from 0 at the top left); repair this pixel, or scale the "
            "image",
            path, largest, index % header.width, index / header.width));
    }
}

}  // namespace phasetree::tracer
