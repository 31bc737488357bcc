// sRGB's electro-optical transfer function (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace phasetree::tracer {

inline float linear_from_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

}  // namespace phasetree::tracer
