#include "denoise/glints.hpp"

#include <algorithm>
#include <array>

#include "image/luminance.hpp"

namespace phasetree::tracer {

namespace {

constexpr float contrast = 32;
constexpr int radius = 2;

float brightness(const Estimate<3>& pixel) {
    return luminance({pixel.mean[0], pixel.mean[1], pixel.mean[2]});
}

}  // namespace

Grid<std::uint8_t> glints_of(const Grid<Estimate<3>>& picture) {
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) sum += static_cast<double>(brightness(picture.at(x, y)));
    const float mean = static_cast<float>(sum / (static_cast<double>(picture.width()) * picture.height()));

    Grid<std::uint8_t> glints(picture.width(), picture.height());
    std::array<float, (2 * radius + 1) * (2 * radius + 1) - 1> around;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const float own = brightness(picture.at(x, y));
            if (!(own > contrast * mean)) continue;
            auto next = around.begin();
            for (int dy = -radius; dy <= radius; ++dy)
                for (int dx = -radius; dx <= radius; ++dx)
                    if (dx != 0 || dy != 0) *next++ = brightness(picture.at(x + dx, y + dy));
            const auto middle = around.begin() + around.size() / 2;
            std::nth_element(around.begin(), middle, around.end());
            glints.at(x, y) = own > contrast * *middle ? 1 : 0;
        }
    return glints;
}

}  // namespace phasetree::tracer
