#include "denoise/halves.hpp"

#include <fmt/format.h>

#include <span>
#include <string_view>
#include <vector>

#include "denoise/channels.hpp"
#include "film/half_plane.hpp"

namespace phasetree::tracer {

namespace {

// The channel of a feature over all samples has the name of that of the half without "half_".
std::string_view name_by_all(std::string_view of_half) {
    return of_half.substr(std::string_view("half_").size());
}

// The means of both halves, of one channel at one pixel.
struct Split {
    float first, second;
};

Split split(float mean, float first, double samples, double in_first) {
    const double second =
        (static_cast<double>(mean) * samples - static_cast<double>(first) * in_first) / (samples - in_first);
    return {first, static_cast<float>(second)};
}

// The variance of the mean of all samples, from the two halves: (a − b)² is σ² (1/m + 1/(n − m)) on average.
float variance_of_mean(const Split& halves, double share) {
    const double difference = static_cast<double>(halves.first) - static_cast<double>(halves.second);
    return static_cast<float>(difference * difference * share * (1 - share));
}

// Averages variances over 3×3 pixels, because each of them is a very noisy estimate.
template <std::size_t N>
void smooth_variances(Grid<Estimate<N>>& grid) {
    Grid<std::array<float, N>> sums(grid.width(), grid.height());
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    for (std::size_t c = 0; c < N; ++c) sums.at(x, y)[c] += grid.at(x + dx, y + dy).variance[c] / 9.0f;
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x) grid.at(x, y).variance = sums.at(x, y);
    grid.fill_margin();
}

// Added to the features' variances, because features without noise differ by rounding.
constexpr float least_variance_of_features = 1e-8f;

void check_halves(std::span<const float> samples, std::span<const float> in_first) {
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (in_first[i] < 1 || samples[i] - in_first[i] < 1)
            throw DenoiseError(
                fmt::format("denoising needs at least {} samples in every pixel", fewest_samples_to_denoise));
}

}  // namespace

Halves halves_of(const Image& image) {
    const std::span<const float> samples = channel_of(image, "samples.X");
    const std::span<const float> in_first = channel_of(image, HalfOfSamplesPlane::channel_names.back());
    check_halves(samples, in_first);
    Halves halves(image.width, image.height);
    std::vector<std::span<const float>> first, all;
    for (std::size_t c = 0; c < HalfOfSamplesPlane::values; ++c) {
        first.push_back(channel_of(image, HalfOfSamplesPlane::channel_names[c]));
        if (c >= 3) all.push_back(channel_of(image, name_by_all(HalfOfSamplesPlane::channel_names[c])));
    }
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
            const auto n = static_cast<double>(samples[i]), m = static_cast<double>(in_first[i]);
            const double share = m / n;
            halves.shares.at(x, y) = static_cast<float>(share);
            for (std::size_t c = 0; c < 3; ++c) {
                const Split both = split(image.pixels[i][static_cast<int>(c)], first[c][i], n, m);
                const float variance = variance_of_mean(both, share);
                halves.pictures[0].at(x, y).mean[c] = both.first;
                halves.pictures[1].at(x, y).mean[c] = both.second;
                halves.pictures[0].at(x, y).variance[c] = variance / static_cast<float>(share);
                halves.pictures[1].at(x, y).variance[c] = variance / static_cast<float>(1 - share);
            }
            for (std::size_t c = 0; c < feature_count; ++c) {
                const float mean = all[c][i];
                const Split both = split(mean, first[c + 3][i], n, m);
                halves.features.at(x, y).mean[c] = mean;
                halves.features.at(x, y).variance[c] = variance_of_mean(both, share) + least_variance_of_features;
            }
        }
    halves.features.fill_margin();
    for (auto& picture : halves.pictures) {
        picture.fill_margin();
        smooth_variances(picture);
    }
    smooth_variances(halves.features);
    return halves;
}

}  // namespace phasetree::tracer
