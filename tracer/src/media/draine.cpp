#include "media/draine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "media/scattered_direction.hpp"

namespace phasetree::tracer {

namespace {

// The root of an increasing function in [low, high], from a first guess.
// `value` returns the function and its derivative.
template <class Value>
double root(const Value& value, double low, double high, double guess) {
    double x = std::clamp(guess, low, high);
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps; ++step) {
        const auto [f, slope] = value(x);
        (f > 0 ? high : low) = x;
        double next = x - f / slope;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - x) <= 1e-14 * (high + low)) return next;
        x = next;
    }
    return x;
}

struct ValueAndSlope {
    double value, slope;
};

}  // namespace

Draine::Draine(float g, float alpha) : g_(std::abs(g) < 1e-3f ? 0.0f : g), alpha_(alpha) {
    const double g2 = static_cast<double>(g_) * static_cast<double>(g_);
    norm_ = 1 + static_cast<double>(alpha_) * (1 + 2 * g2) / 3;
}

float Draine::mean_cosine() const {
    const double g = static_cast<double>(g_), alpha = static_cast<double>(alpha_);
    return static_cast<float>(g * (1 + alpha * (3 + 2 * g * g) / 5) / norm_);
}

float Draine::evaluate(float cosine) const {
    const double g = static_cast<double>(g_), mu = static_cast<double>(cosine), least = 1 - std::abs(g);
    const double squared = std::max(1 + g * g - 2 * g * mu, least * least);
    const double by_alpha = (1 + static_cast<double>(alpha_) * mu * mu) / norm_;
    return static_cast<float>((1 - g * g) / (4 * std::numbers::pi * squared * std::sqrt(squared)) * by_alpha);
}

// 1 − μ, where u is the probability of a larger cosine. g is positive.
double Draine::below_pole(double u) const {
    const double g = std::abs(static_cast<double>(g_)), alpha = static_cast<double>(alpha_);
    if (g == 0) {
        // (1 − μ + α (1 − μ³)/3)/(2 norm) = u, for h = 1 − μ.
        const auto value = [&](double h) {
            const double mu = 1 - h;
            return ValueAndSlope{(h + alpha * (h - h * h + h * h * h / 3)) / (2 * norm_) - u,
                                 (1 + alpha * mu * mu) / (2 * norm_)};
        };
        return root(value, 0.0, 2.0, 2 * u);
    }
    const double sum = 1 + g * g, factor = (1 - g * g) / (2 * norm_ * g), weight = alpha / (4 * g * g);
    const auto primitive = [&](double s) { return -1 / s + weight * (-sum * sum / s - 2 * sum * s + s * s * s / 3); };
    const double least = 1 - g, before = primitive(least);
    const auto value = [&](double s) {
        const double mu = (sum - s * s) / (2 * g);
        return ValueAndSlope{factor * (primitive(s) - before) - u, factor * (1 + alpha * mu * mu) / (s * s)};
    };
    const double s = root(value, least, 1 + g, (1 - g * g) / (1 - g + 2 * g * (1 - u)));
    return (s * s - least * least) / (2 * g);
}

glm::vec3 Draine::sample(const glm::vec2& u) const {
    const auto chosen = static_cast<double>(u.x);
    if (g_ >= 0.0f) return scattered_direction(static_cast<float>(below_pole(chosen)), u.y);
    // A negative g is the same function of −μ.
    const glm::vec3 mirrored = scattered_direction(static_cast<float>(below_pole(1 - chosen)), u.y);
    return {mirrored.x, mirrored.y, -mirrored.z};
}

}  // namespace phasetree::tracer
