#include "output/quantise.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {
namespace {

// NaN compares false with everything, and becomes 0.
float unit(float v) {
    return v > 0.0f ? std::min(v, 1.0f) : 0.0f;
}

}  // namespace

float dither_threshold(int x, int y) {
    // 2³² / ρ and 2³² / ρ², where ρ³ = ρ + 1. Integer overflow yields the fractional part.
    constexpr std::uint32_t inverse_plastic = 3242174889u;
    constexpr std::uint32_t inverse_plastic_squared = 2447445414u;
    const std::uint32_t h =
        static_cast<std::uint32_t>(x) * inverse_plastic + static_cast<std::uint32_t>(y) * inverse_plastic_squared;
    // 256 levels at odd multiples of 1/512. Rounding errors of the display transform are far smaller, so they cannot
    // push a value that is exactly a code to a neighbouring one.
    return (static_cast<float>(h >> 24) + 0.5f) / 256.0f;
}

std::vector<std::uint8_t> quantise8(std::span<const glm::vec3> pixels, int width, int x0, int y0) {
    std::vector<std::uint8_t> codes;
    codes.reserve(pixels.size() * 3);
    int x = 0;
    int y = 0;
    for (const glm::vec3& pixel : pixels) {
        const float threshold = dither_threshold(x0 + x, y0 + y);
        for (int c = 0; c < 3; ++c) {
            codes.push_back(static_cast<std::uint8_t>(std::floor(unit(pixel[c]) * 255.0f + threshold)));
        }
        if (++x == width) {
            x = 0;
            ++y;
        }
    }
    return codes;
}

std::vector<std::uint16_t> quantise16(std::span<const glm::vec3> pixels) {
    std::vector<std::uint16_t> codes;
    codes.reserve(pixels.size() * 3);
    for (const glm::vec3& pixel : pixels) {
        for (int c = 0; c < 3; ++c) {
            codes.push_back(static_cast<std::uint16_t>(std::floor(unit(pixel[c]) * 65535.0f + 0.5f)));
        }
    }
    return codes;
}

}  // namespace phasetree::tracer
