// Source of D65: CIE 15, Colorimetry, table of relative spectral power distributions, in steps of 10 nm. ρ was computed
// by tracer/color/upsampling.py, which says how; the idea is that of Mallett & Yuksel, Spectral Primary Decomposition
// for Rendering with sRGB Reflectance, EGSR 2019.
#include "spectrum/wavelength.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectrum/colour_matching.hpp"

namespace phasetree::tracer {

namespace {

constexpr double first = 380.0, step = 10.0;
constexpr std::size_t nodes = 41;

constexpr std::array<double, nodes> daylight{
    49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
    108.811, 109.354, 107.802, 104.79,  107.689, 104.405, 104.046, 100.0,   96.3342, 95.788,  88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
    74.349,  61.604,  69.8856, 75.087,  63.5927, 46.4182, 66.8054, 63.3828};

const std::array<glm::vec3, nodes> primaries{{
    {0.0515853f, 0.0000000f, 0.9484147f},  // 380 nm
    {0.0517779f, 0.0000000f, 0.9482221f},  // 390 nm
    {0.0525672f, 0.0000000f, 0.9474328f},  // 400 nm
    {0.0534831f, 0.0000000f, 0.9465169f},  // 410 nm
    {0.0513974f, 0.0000000f, 0.9486026f},  // 420 nm
    {0.0439393f, 0.0000000f, 0.9560607f},  // 430 nm
    {0.0319021f, 0.0000000f, 0.9680979f},  // 440 nm
    {0.0148479f, 0.0000000f, 0.9851521f},  // 450 nm
    {0.0081316f, 0.0076980f, 0.9841704f},  // 460 nm
    {0.0000000f, 0.1190221f, 0.8809779f},  // 470 nm
    {0.0000000f, 0.2931262f, 0.7068738f},  // 480 nm
    {0.0000000f, 0.4942639f, 0.5057361f},  // 490 nm
    {0.0000000f, 0.6882833f, 0.3117167f},  // 500 nm
    {0.0000000f, 0.8493612f, 0.1506388f},  // 510 nm
    {0.0000000f, 0.9575825f, 0.0424175f},  // 520 nm
    {0.0000000f, 1.0000000f, 0.0000000f},  // 530 nm
    {0.0000000f, 1.0000000f, 0.0000000f},  // 540 nm
    {0.0000000f, 1.0000000f, 0.0000000f},  // 550 nm
    {0.0000000f, 1.0000000f, 0.0000000f},  // 560 nm
    {0.0000000f, 1.0000000f, 0.0000000f},  // 570 nm
    {0.1840019f, 0.8159981f, 0.0000000f},  // 580 nm
    {0.4939964f, 0.5060036f, 0.0000000f},  // 590 nm
    {0.7544587f, 0.1689950f, 0.0765463f},  // 600 nm
    {0.9434251f, 0.0000000f, 0.0565749f},  // 610 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 620 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 630 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 640 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 650 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 660 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 670 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 680 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 690 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 700 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 710 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 720 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 730 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 740 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 750 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 760 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 770 nm
    {1.0000000f, 0.0000000f, 0.0000000f},  // 780 nm
}};

// Linear between the nodes.
template <class T>
T between_nodes(const std::array<T, nodes>& values, double wavelength) {
    const double at = std::clamp((wavelength - first) / step, 0.0, static_cast<double>(nodes - 1));
    const std::size_t below = std::min(static_cast<std::size_t>(at), nodes - 2);
    using Scalar = std::conditional_t<std::is_same_v<T, double>, double, float>;
    const auto part = static_cast<Scalar>(at - static_cast<double>(below));
    return (Scalar(1) - part) * values[below] + part * values[below + 1];
}

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

glm::vec3 primaries_at(double wavelength) {
    return between_nodes(primaries, wavelength);
}

double daylight_at(double wavelength) {
    return between_nodes(daylight, wavelength);
}

}  // namespace phasetree::tracer
