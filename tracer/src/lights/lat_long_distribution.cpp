#include "lights/lat_long_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lights/lat_long.hpp"

namespace phasetree::tracer {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

// The interval of a cumulative distribution that u falls into, and where in it, in [0, 1). Empty intervals are skipped.
struct Inverse {
    int index;
    float position;
};

Inverse invert(std::span<const float> cumulative, float u) {
    constexpr float below_one = 0x1.fffffep-1f;
    const float inside = std::clamp(u, 0.0f, below_one);
    const auto above = std::upper_bound(cumulative.begin(), cumulative.end(), inside);
    const auto index = static_cast<std::size_t>(above - cumulative.begin()) - 1;
    const float position = (inside - cumulative[index]) / (cumulative[index + 1] - cumulative[index]);
    return {static_cast<int>(index), std::clamp(position, 0.0f, below_one)};
}

// Writes the running sums of `weights`, scaled to end at exactly 1 (all zero if there is nothing to sum); returns the
// sum.
double accumulate(std::span<const double> weights, std::span<float> cumulative) {
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

}  // namespace

LatLongDistribution::LatLongDistribution(int width, int height, std::span<const float> means)
    : width_(width), height_(height) {
    if (width < 1 || height < 1 || means.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        throw std::invalid_argument("an environment's distribution needs one value for each of its cells");
    }
    const auto w = static_cast<std::size_t>(width);
    const auto h = static_cast<std::size_t>(height);
    cos_theta_.resize(h + 1);
    for (std::size_t row = 0; row <= h; ++row) {
        cos_theta_[row] = std::cos(std::numbers::pi * static_cast<double>(row) / static_cast<double>(h));
    }
    rows_.resize(h + 1);
    columns_.resize(h * (w + 1));
    std::vector<double> row_weights(h);
    std::vector<double> weights(w);
    for (std::size_t row = 0; row < h; ++row) {
        const auto line = means.subspan(row * w, w);
        std::copy(line.begin(), line.end(), weights.begin());
        const double sum = accumulate(weights, std::span(columns_).subspan(row * (w + 1), w + 1));
        const double cell_solid_angle = full_turn / static_cast<double>(w) * (cos_theta_[row] - cos_theta_[row + 1]);
        row_weights[row] = sum * cell_solid_angle;
    }
    integral_ = static_cast<float>(accumulate(row_weights, rows_));
    if (!std::isfinite(integral_)) throw std::invalid_argument("an environment's radiance must be finite");
}

std::span<const float> LatLongDistribution::columns_of(int row) const {
    const auto line = static_cast<std::size_t>(width_) + 1;
    return std::span(columns_).subspan(static_cast<std::size_t>(row) * line, line);
}

float LatLongDistribution::cell_pdf(int column, int row) const {
    // From the stored, rounded sums: exactly the probabilities with which sample() chooses.
    const auto c = static_cast<std::size_t>(column);
    const auto r = static_cast<std::size_t>(row);
    const auto columns = columns_of(row);
    const double probability = static_cast<double>(rows_[r + 1] - rows_[r]) * (columns[c + 1] - columns[c]);
    const double solid_angle = full_turn / width_ * (cos_theta_[r] - cos_theta_[r + 1]);
    return static_cast<float>(probability / solid_angle);
}

std::optional<DirectionSample> LatLongDistribution::sample(const glm::vec2& u) const {
    if (!(integral_ > 0.0f)) return std::nullopt;
    const Inverse row = invert(rows_, u.y);
    const Inverse column = invert(columns_of(row.index), u.x);
    const auto r = static_cast<std::size_t>(row.index);
    const double cos_theta = cos_theta_[r] + row.position * (cos_theta_[r + 1] - cos_theta_[r]);
    const double azimuth = full_turn * ((column.index + static_cast<double>(column.position)) / width_ - 0.5);
    return DirectionSample{direction_of(azimuth, cos_theta), cell_pdf(column.index, row.index)};
}

float LatLongDistribution::pdf(const glm::vec3& direction) const {
    const glm::vec2 uv = lat_long_of(direction);
    const int column = std::clamp(static_cast<int>(uv.x * static_cast<float>(width_)), 0, width_ - 1);
    const int row = std::clamp(static_cast<int>(uv.y * static_cast<float>(height_)), 0, height_ - 1);
    return cell_pdf(column, row);
}

}  // namespace phasetree::tracer
