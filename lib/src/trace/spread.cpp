#include <algorithm>
#include <cmath>

#include "trace/march.hpp"

namespace phasetree {

BatchOfFloats spread_evenly(float low, float high) {
    BatchOfFloats t;
    const float step = (high - low) / static_cast<float>(batch_size - 1);
    for (std::size_t i = 0; i < batch_size; ++i) t[i] = low + step * static_cast<float>(i);
    t[batch_size - 1] = high;
    return t;
}

BatchOfFloats spread_from(float low, float high, float smallest) {
    BatchOfFloats t;
    const float length = high - low;
    const float ratio = std::exp2(std::log2(std::max(length / smallest, 2.f)) / static_cast<float>(batch_size - 1));
    float d = smallest;
    for (std::size_t i = 0; i < batch_size; ++i, d *= ratio) t[i] = low + std::min(d, length);
    t[batch_size - 1] = high;
    return t;
}

BatchOfFloats spread_growing(float low, float high, float s, float slope) {
    // Two balls cover a step d if d ≤ s + (s + slope·d); a tenth less, for what is not straight.
    const float growth = 1.8f / (1.f - 0.9f * slope);
    BatchOfFloats t;
    float at = low;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const float step = growth * s;
        at = std::min(at + step, high);
        s += slope * step;
        t[i] = at;
    }
    return t;
}

BatchOfFloats gather_around(float root, float low, float high, float smallest) {
    constexpr std::size_t half = batch_size / 2;
    BatchOfFloats t;
    // Each side reaches from the smallest offset to half way to its end, in equal ratios.
    const auto side = [&](float reach, auto&& put) {
        const float last = std::max(0.6f * reach, smallest);
        const float ratio = std::exp2(std::log2(last / smallest) / static_cast<float>(half - 1));
        float d = smallest;
        for (std::size_t i = 0; i < half; ++i, d *= ratio) put(i, std::min(d, reach));
    };
    side(root - low, [&](std::size_t i, float d) { t[half - 1 - i] = root - d; });
    side(high - root, [&](std::size_t i, float d) { t[half + i] = root + d; });
    return t;
}

}  // namespace phasetree
