// The similarity of the neighbourhoods of two pixels, as in non-local means: the mean square difference of their
// patches, minus what noise alone contributes, in units of that noise,
//
//     d(p, q) = mean over patches and channels of ((u_p − u_q)² − (v_p + min(v_p, v_q))) / (ε + k² (v_p + v_q)),
//     w(p, q) = exp(−max(d, 0)),
//
// where v is the variance of u. Source: Rousselle, Knaus & Zwicker, Adaptive Rendering with Non-Local Means Filtering,
// ACM Transactions on Graphics 31(6), 2012, equations 4 to 6.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "denoise/halves.hpp"
#include "film/pixel_range.hpp"

namespace phasetree::tracer {

/// Radius of patches, in pixels.
inline constexpr int patch_radius = 2;

/// The weights w of the pixels of an area, row by row, with those at the offset (dx, dy) from them. Uses the channels
/// [first, first + Channels) of the guide. A smaller `k` distinguishes more.
template <std::size_t Channels, std::size_t N>
void weigh(const Grid<Estimate<N>>& guide, std::size_t first, const PixelRange& area, int dx, int dy, float k,
           std::span<float> weights) {
    constexpr float nothing = 1e-10f;
    constexpr int side = 2 * patch_radius + 1;
    const int width = area.width(), wide = width + 2 * patch_radius, high = area.height() + 2 * patch_radius;
    // Differences of pixels, then their sums over the rows of patches.
    std::vector<float> differences(static_cast<std::size_t>(wide)), rows(static_cast<std::size_t>(width * high));
    for (int j = 0; j < high; ++j) {
        const int y = area.y0 + j - patch_radius;
        for (int i = 0; i < wide; ++i) {
            const int x = area.x0 + i - patch_radius;
            const Estimate<N>&p = guide.at(x, y), &q = guide.at(x + dx, y + dy);
            float sum = 0;
            for (std::size_t c = first; c < first + Channels; ++c) {
                const float u = p.mean[c] - q.mean[c], v = p.variance[c], least = std::min(v, q.variance[c]);
                sum += (u * u - (v + least)) / (nothing + k * k * (v + q.variance[c]));
            }
            differences[static_cast<std::size_t>(i)] = sum;
        }
        for (int i = 0; i < width; ++i) {
            float sum = 0;
            for (int s = 0; s < side; ++s) sum += differences[static_cast<std::size_t>(i + s)];
            rows[static_cast<std::size_t>(j * width + i)] = sum;
        }
    }
    constexpr float scale = 1.0f / static_cast<float>(side * side * static_cast<int>(Channels));
    for (int j = 0; j < area.height(); ++j)
        for (int i = 0; i < width; ++i) {
            float sum = 0;
            for (int s = 0; s < side; ++s) sum += rows[static_cast<std::size_t>((j + s) * width + i)];
            weights[static_cast<std::size_t>(j * width + i)] = std::exp(-std::max(sum * scale, 0.0f));
        }
}

}  // namespace phasetree::tracer
