#include "film/pixel_filter.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sampling/inversion.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::array<double, 4> harris{0.35875, 0.48829, 0.14128, 0.01168};
constexpr double full_turn = 2.0 * std::numbers::pi;

double window(double t) {
    return harris[0] - harris[1] * std::cos(full_turn * t) + harris[2] * std::cos(2.0 * full_turn * t) -
           harris[3] * std::cos(3.0 * full_turn * t);
}

// ∫₀ᵗ window / ∫₀¹ window
double window_integral(double t) {
    const double sines = -harris[1] * std::sin(full_turn * t) + harris[2] / 2.0 * std::sin(2.0 * full_turn * t) -
                         harris[3] / 3.0 * std::sin(3.0 * full_turn * t);
    return t + sines / (full_turn * harris[0]);
}

}  // namespace

PixelFilter::PixelFilter(Shape shape, float radius) : shape_(shape), radius_(radius) {
    if (!(radius > 0.0f) || !(radius <= 64.0f)) {
        throw std::invalid_argument("the pixel filter's radius must be above 0 and at most 64 pixels");
    }
    if (shape == Shape::box) return;
    constexpr std::size_t intervals = 512;
    cumulative_.resize(intervals + 1);
    for (std::size_t i = 0; i <= intervals; ++i) {
        cumulative_[i] = static_cast<float>(window_integral(static_cast<double>(i) / intervals));
    }
    cumulative_.front() = 0.0f;
    cumulative_.back() = 1.0f;
}

float PixelFilter::sample(float u) const {
    float t = u;
    if (shape_ == Shape::blackman_harris) {
        const Inverse inverse = invert(cumulative_, u);
        t = (static_cast<float>(inverse.index) + inverse.position) / static_cast<float>(cumulative_.size() - 1);
    }
    return radius_ * (2.0f * t - 1.0f);
}

float PixelFilter::pdf(float x) const {
    if (!(std::abs(x) <= radius_)) return 0.0f;
    if (shape_ == Shape::box) return 0.5f / radius_;
    const double t = 0.5 * (static_cast<double>(x) / static_cast<double>(radius_) + 1.0);
    return static_cast<float>(window(t) / (2.0 * static_cast<double>(radius_) * harris[0]));
}

}  // namespace phasetree::tracer
