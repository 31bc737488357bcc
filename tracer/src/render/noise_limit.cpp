#include "render/noise_limit.hpp"

#include <cmath>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

std::vector<PixelRange> blocks_of(const PixelRange& area) {
    std::vector<PixelRange> blocks;
    const auto first = [](int n) { return n / block_side * block_side; };
    for (int y = first(area.y0); y < area.y1; y += block_side)
        for (int x = first(area.x0); x < area.x1; x += block_side)
            blocks.push_back({std::max(x, area.x0), std::max(y, area.y0), std::min(x + block_side, area.x1),
                              std::min(y + block_side, area.y1)});
    return blocks;
}

PixelRange whole_blocks(const PixelRange& area, const FilmSettings& film) {
    const auto down = [](int n) { return n / block_side * block_side; };
    const auto up = [&](int n, int most) { return std::min(down(n + block_side - 1), most); };
    return {down(area.x0), down(area.y0), up(area.x1, film.width), up(area.y1, film.height)};
}

std::optional<NoiseLimit> NoiseLimit::of(const RenderSettings& settings) {
    if (!(settings.noise > 0)) return std::nullopt;
    return NoiseLimit(static_cast<double>(settings.noise),
                      0.01 * portable::exp2(-static_cast<double>(settings.exposure_ev)));
}

int NoiseLimit::next_look(int done) {
    int look = 32;
    while (look <= done) {
        if (look + look / 2 > done) return look + look / 2;
        look *= 2;
    }
    return look;
}

bool NoiseLimit::is_met(const FilmTile& pixels, const PixelRange& block) const {
    const std::uint32_t samples = pixels.samples(block.x0, block.y0);
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
            if (pixels.samples(x, y) != samples) return false;
    return is_look(static_cast<int>(samples)) && error(pixels, block) <= limit_;
}

double NoiseLimit::error(const FilmTile& pixels, const PixelRange& block) const {
    double sum = 0;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
            const std::uint32_t samples = pixels.samples(x, y);
            const MeanAndVariance& luminance = pixels.sums_of<NoisePlane>(x, y)[0];
            const double mean = std::max(luminance.mean(samples), darkest_);
            sum += luminance.variance_of_mean(samples) / (mean * mean);
        }
    return std::sqrt(sum / static_cast<double>(block.size()));
}

}  // namespace phasetree::tracer
