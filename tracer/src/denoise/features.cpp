#include "denoise/features.hpp"

#include "denoise/similarity.hpp"

namespace phasetree::tracer {

namespace {

constexpr int feature_radius = 3;
constexpr float feature_k = 1;

template <std::size_t First>
void filter_group(const Grid<Estimate<feature_count>>& noisy, const PixelRange& area, std::vector<Features>& clean) {
    std::vector<float> weights(area.size()), total(area.size());
    for (int dy = -feature_radius; dy <= feature_radius; ++dy)
        for (int dx = -feature_radius; dx <= feature_radius; ++dx) {
            weigh<3>(noisy, First, area, dx, dy, feature_k, weights);
            for (int y = area.y0; y < area.y1; ++y)
                for (int x = area.x0; x < area.x1; ++x) {
                    if (!noisy.has(x + dx, y + dy)) continue;
                    const std::size_t i = area.index(x, y);
                    const Features& other = noisy.at(x + dx, y + dy).mean;
                    for (std::size_t c = First; c < First + 3; ++c) clean[i][c] += weights[i] * other[c];
                    total[i] += weights[i];
                }
        }
    for (std::size_t i = 0; i < area.size(); ++i)
        for (std::size_t c = First; c < First + 3; ++c) clean[i][c] /= total[i];
}

}  // namespace

std::vector<Features> without_noise(const Grid<Estimate<feature_count>>& features, const PixelRange& area) {
    static_assert(feature_count == 12);
    std::vector<Features> clean(area.size());
    filter_group<0>(features, area, clean);
    filter_group<3>(features, area, clean);
    filter_group<6>(features, area, clean);
    filter_group<9>(features, area, clean);
    return clean;
}

}  // namespace phasetree::tracer
