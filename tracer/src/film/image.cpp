#include "film/image.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

namespace {

template <class T>
std::vector<T> part_of_rows(const std::vector<T>& values, int stride, int x0, int y0, int width, int height) {
    std::vector<T> part;
    for (int y = y0; y < y0 + height; ++y) {
        const auto row = values.begin() + static_cast<std::ptrdiff_t>(y) * stride + x0;
        part.insert(part.end(), row, row + width);
    }
    return part;
}

}  // namespace

Image part_of(const Image& image, int x0, int y0, int width, int height) {
    Image part;
    part.width = width;
    part.height = height;
    part.pixels = part_of_rows(image.pixels, image.width, x0, y0, width, height);
    for (const Channel& channel : image.extra_channels)
        part.extra_channels.push_back({channel.name, part_of_rows(channel.values, image.width, x0, y0, width, height)});
    part.attributes = image.attributes;
    const Crop whole = image.crop.value_or(Crop{0, 0, image.width, image.height});
    part.crop = Crop{whole.x0 + x0, whole.y0 + y0, whole.display_width, whole.display_height};
    if (width == whole.display_width && height == whole.display_height) part.crop.reset();
    return part;
}

std::size_t count_non_finite(const Image& image) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3& p = image.pixels[i];
        const bool finite =
            std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) &&
            std::ranges::all_of(image.extra_channels, [&](const Channel& c) { return std::isfinite(c.values[i]); });
        count += finite ? 0 : 1;
    }
    return count;
}

}  // namespace phasetree::tracer
