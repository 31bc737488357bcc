#include "nodes/voxels/lines.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace phasetree::voxels {

namespace {

// The number of lines processed at a time, one per lane. All lanes perform the same operations on adjacent memory,
// which compilers vectorise. Lanes are independent of each other.
constexpr std::size_t lanes = 16;

// `lanes` lines, interleaved: value k of the line in a lane is at lanes · k + lane.
using Bundle = std::vector<float>;

// Calls work(bundle) for all lines along an axis, on all threads. Lines are copied to a bundle and back, unless all
// their values are equal. Most lines contain a single phase or none of it, and neither operation on lines changes such
// a line.
template <class Work>
void for_each_bundle(std::size_t axis, std::vector<float>& values, const Size& size, const Work& work) {
    const std::array<std::size_t, 3> n{static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1]),
                                       static_cast<std::size_t>(size[2])};
    const std::array<std::size_t, 3> stride{1, n[0], n[0] * n[1]};
    const std::size_t across = axis == 0 ? 1 : 0, outer = 3 - axis - across;
    const std::size_t bundles = (n[across] + lanes - 1) / lanes;  // at each position along the outer axis
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n[outer] * bundles), [&](const auto& range) {
        Bundle bundle(n[axis] * lanes);
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const std::size_t begin = i % bundles * lanes, count = std::min(lanes, n[across] - begin);
            float* first = values.data() + begin * stride[across] + i / bundles * stride[outer];
            std::array<bool, lanes> varies{};
            for (std::size_t k = 0; k < n[axis]; ++k)
                for (std::size_t lane = 0; lane < count; ++lane) {
                    const float v = first[k * stride[axis] + lane * stride[across]];
                    bundle[k * lanes + lane] = v;
                    varies[lane] = varies[lane] || v != bundle[lane];
                }
            if (std::ranges::none_of(varies, [](bool b) { return b; })) continue;
            work(bundle);
            for (std::size_t lane = 0; lane < count; ++lane) {
                if (!varies[lane]) continue;
                for (std::size_t k = 0; k < n[axis]; ++k)
                    first[k * stride[axis] + lane * stride[across]] = bundle[k * lanes + lane];
            }
        }
    });
}

}  // namespace

std::size_t count_of(const Size& n) {
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
}

Blur::Blur(float sigma) {
    const int radius = static_cast<int>(std::ceil(3.5f * sigma));
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) {
        const double x = sigma > 0 ? i / static_cast<double>(sigma) : 0;
        weights_.push_back(static_cast<float>(std::exp(-0.5 * x * x)));
        sum += static_cast<double>(weights_.back());
    }
    for (float& w : weights_) w = static_cast<float>(static_cast<double>(w) / sum);
}

void Blur::along(std::size_t axis, std::vector<float>& values, const Size& size) const {
    if (weights_.size() == 1) return;
    for_each_bundle(axis, values, size, [&](Bundle& bundle) {
        const std::size_t n = bundle.size() / lanes, radius = weights_.size() / 2;
        Bundle longer((n + 2 * radius) * lanes);
        for (std::size_t k = 0; k < n + 2 * radius; ++k) {
            const std::size_t inside = std::clamp(k, radius, radius + n - 1) - radius;
            std::copy_n(bundle.data() + inside * lanes, lanes, longer.data() + k * lanes);
        }
        for (std::size_t i = 0; i < n; ++i) {
            std::array<float, lanes> sum{};
            for (std::size_t k = 0; k < weights_.size(); ++k) {
                const float* shifted = longer.data() + (i + k) * lanes;
                for (std::size_t lane = 0; lane < lanes; ++lane) sum[lane] += weights_[k] * shifted[lane];
            }
            std::ranges::copy(sum, bundle.data() + i * lanes);
        }
    });
}

// Gaussian elimination without pivoting is stable here, because the matrix is diagonally dominant.
void to_spline_along(std::size_t axis, std::vector<float>& values, const Size& size) {
    const auto n = static_cast<std::size_t>(size[axis]);
    std::vector<double> pivot(n), above(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double beyond = (i == 0 ? 1. / 8 : 0) + (i + 1 == n ? 1. / 8 : 0);  // the line continues with its last
                                                                                  // value
        pivot[i] = 6. / 8 + beyond - (i > 0 ? above[i - 1] / 8 : 0);
        above[i] = 1. / 8 / pivot[i];
    }
    for_each_bundle(axis, values, size, [&](Bundle& bundle) {
        std::vector<std::array<double, lanes>> right(n);
        std::array<double, lanes> last{};
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t lane = 0; lane < lanes; ++lane)
                last[lane] = (static_cast<double>(bundle[i * lanes + lane]) - last[lane] / 8) / pivot[i];
            right[i] = last;
        }
        std::array<double, lanes> c{};
        for (std::size_t i = n; i-- > 0;)
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                c[lane] = right[i][lane] - (i + 1 < n ? above[i] * c[lane] : 0);
                bundle[i * lanes + lane] = static_cast<float>(c[lane]);
            }
    });
}

}  // namespace phasetree::voxels
