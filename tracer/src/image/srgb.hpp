// sRGB's transfer functions (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

inline float linear_from_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

inline float srgb_from_linear(float value) {
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

/// The nearest code, from 0 to 255; values outside of [0, 1] are clamped.
inline int srgb_code(float value) {
    return static_cast<int>(std::lround(255.0f * srgb_from_linear(std::clamp(value, 0.0f, 1.0f))));
}

}  // namespace phasetree::tracer
