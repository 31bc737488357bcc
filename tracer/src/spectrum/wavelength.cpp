#include "spectrum/wavelength.hpp"

#include <algorithm>
#include <cmath>

#include "spectrum/colour_matching.hpp"
#include "spectrum/daylight.hpp"
#include "spectrum/primaries.hpp"

namespace phasetree::tracer {

namespace {

constexpr double first = 380.0;

double size_of(const glm::dvec3& w) {
    return std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
}

const WavelengthDistribution& by_response() {
    static const WavelengthDistribution all;
    return all;
}

}  // namespace

WavelengthDistribution::WavelengthDistribution() : WavelengthDistribution([](double) { return 1.0; }) {}

WavelengthDistribution::WavelengthDistribution(const std::function<double(double)>& light) {
    glm::dvec3 sum(0.0);
    std::array<glm::dvec3, cells> weights;
    std::array<double, cells> sizes;
    for (std::size_t i = 0; i < cells; ++i) {
        const double middle = first + static_cast<double>(i) + 0.5;
        weights[i] = daylight_at(middle) * rec709_from_xyz(colour_matching(middle));
        sum += weights[i];
    }
    double total = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
        weights[i] /= sum;
        sizes[i] = size_of(weights[i]) * light(first + static_cast<double>(i) + 0.5);
        total += sizes[i];
    }
    double below = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
        const double probability = sizes[i] / total;
        below += probability;
        cumulative_[i] = below;
        response_[i] = glm::vec3(weights[i] / probability);
    }
}

Wavelength WavelengthDistribution::sample(float u) const {
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, static_cast<double>(u));
    const auto cell = static_cast<std::size_t>(found - cumulative_.begin());
    const double before = cell > 0 ? cumulative_[cell - 1] : 0.0;
    const double part = (static_cast<double>(u) - before) / (cumulative_[cell] - before);
    const double wavelength = first + static_cast<double>(cell) + std::clamp(part, 0.0, 1.0);
    return {static_cast<float>(wavelength), primaries_at(wavelength), response_[cell]};
}

glm::dvec3 WavelengthDistribution::colour_of(const std::function<double(double)>& f) const {
    glm::dvec3 sum(0.0);
    double before = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
        sum += f(first + static_cast<double>(i) + 0.5) * (cumulative_[i] - before) * glm::dvec3(response_[i]);
        before = cumulative_[i];
    }
    return sum;
}

double WavelengthDistribution::mean_of(const std::function<double(double)>& f) const {
    double sum = 0.0, before = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
        sum += f(first + static_cast<double>(i) + 0.5) * (cumulative_[i] - before);
        before = cumulative_[i];
    }
    return sum;
}

glm::dvec3 colour_of(const std::function<double(double)>& f) {
    return by_response().colour_of(f);
}

double mean_of(const std::function<double(double)>& f) {
    return by_response().mean_of(f);
}

Wavelength sampled_wavelength(float u) {
    return by_response().sample(u);
}

}  // namespace phasetree::tracer
