// Sampling a piecewise-constant pdf by inverting its cumulative distribution. Unlike the alias method, inversion is
// monotone and preserves the stratification of sample points.
#pragma once

#include <algorithm>
#include <span>

namespace phasetree::tracer {

/// Writes the prefix sums of `weights`, one more than weights, scaled to end at exactly 1 (all zero if the sum is
/// zero). Returns the sum.
inline double accumulate(std::span<const double> weights, std::span<float> cumulative) {
    double sum = 0.0;
    for (const double weight : weights) sum += weight;
    double running = 0.0;
    cumulative[0] = 0.0f;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        running += weights[i];
        cumulative[i + 1] = sum > 0.0 ? static_cast<float>(running / sum) : 0.0f;
    }
    return sum;
}

/// The interval that contains u, and the position in it.
struct Inverse {
    std::size_t index;
    float position;  ///< in [0, 1)
};

/// `cumulative` increases from 0 to 1; intervals in which it is constant are skipped. The binary search has no
/// branches, which a random u would make unpredictable.
inline Inverse invert(std::span<const float> cumulative, float u) {
    constexpr float below_one = 0x1.fffffep-1f;
    const float inside = std::clamp(u, 0.0f, below_one);
    // The last boundary that is not above u. The final boundary, 1, always is.
    const float* first = cumulative.data();
    for (std::size_t length = cumulative.size(); length > 1;) {
        const std::size_t half = length / 2;
        first += first[half] <= inside ? half : 0;
        length -= half;
    }
    const auto index = std::min(static_cast<std::size_t>(first - cumulative.data()), cumulative.size() - 2);
    const float position = (inside - cumulative[index]) / (cumulative[index + 1] - cumulative[index]);
    return {index, std::clamp(position, 0.0f, below_one)};
}

}  // namespace phasetree::tracer
