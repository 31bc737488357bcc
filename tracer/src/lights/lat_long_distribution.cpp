#include "lights/lat_long_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lights/lat_long.hpp"
#include "sampling/inversion.hpp"

namespace phasetree::tracer {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

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

std::span<const float> LatLongDistribution::columns_of(std::size_t row) const {
    const auto line = static_cast<std::size_t>(width_) + 1;
    return std::span(columns_).subspan(row * line, line);
}

float LatLongDistribution::cell_pdf(std::size_t column, std::size_t row) const {
    // Computed from the stored, rounded sums, so that they are exactly the probabilities with which sample() chooses.
    const auto columns = columns_of(row);
    const double probability =
        static_cast<double>(rows_[row + 1] - rows_[row]) * (columns[column + 1] - columns[column]);
    const double solid_angle = full_turn / width_ * (cos_theta_[row] - cos_theta_[row + 1]);
    return static_cast<float>(probability / solid_angle);
}

std::optional<DirectionSample> LatLongDistribution::sample(const glm::vec2& u) const {
    if (!(integral_ > 0.0f)) return std::nullopt;
    const Inverse row = invert(rows_, u.y);
    const Inverse column = invert(columns_of(row.index), u.x);
    const double cos_theta = cos_theta_[row.index] + row.position * (cos_theta_[row.index + 1] - cos_theta_[row.index]);
    const double azimuth =
        full_turn * ((static_cast<double>(column.index) + static_cast<double>(column.position)) / width_ - 0.5);
    return DirectionSample{direction_of(azimuth, cos_theta), cell_pdf(column.index, row.index)};
}

float LatLongDistribution::pdf(const glm::vec3& direction) const {
    const glm::vec2 uv = lat_long_of(direction);
    const int column = std::clamp(static_cast<int>(uv.x * static_cast<float>(width_)), 0, width_ - 1);
    const int row = std::clamp(static_cast<int>(uv.y * static_cast<float>(height_)), 0, height_ - 1);
    return cell_pdf(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
}

}  // namespace phasetree::tracer
