// What every BSDF must satisfy, as functions that return p-values. A test can thus also show that a defect is detected.
//
// Frame and conventions: shading/bsdf/sample.hpp. The sphere of wi is cut into cells by the polar angle θ and the
// azimuth φ; the expected counts are N times the integral of the pdf over a cell. The integral is a sum over a lattice
// of 64 × 64 points per cell. The lattice is skewed, so that edges of the pdf along parallels average out (there is one
// where the microfacet is vertical). Its error is far below the noise of the counts. Delta samples and samples that end
// the path are counted in a cell of their own.
//
// The planted defect is a skew of 1 %: both uniform numbers of the direction are raised to the power 1.01. The density
// of each then differs from uniform by 0.01 (1 + ln u), a χ²-distance of 1e-4. With 128 cells, samples_to_detect(1e-4,
// 128) = 1.92 million.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "shading/bsdf.hpp"
#include "support/statistics.hpp"
#include "support/uniform.hpp"

namespace phasetree::tests {

constexpr int polar_cells = 16;
constexpr int angle_cells = 8;
constexpr int direction_cells = polar_cells * angle_cells;

inline std::size_t direction_cell(const glm::vec3& w) {
    constexpr float pi = std::numbers::pi_v<float>;
    const float theta = std::atan2(std::sqrt(w.x * w.x + w.y * w.y), w.z);
    const float turn = std::atan2(w.y, w.x) / (2.0f * pi);
    const int row = std::clamp(static_cast<int>(theta / pi * polar_cells), 0, polar_cells - 1);
    const int column =
        std::clamp(static_cast<int>((turn < 0.0f ? turn + 1.0f : turn) * angle_cells), 0, angle_cells - 1);
    return static_cast<std::size_t>(row * angle_cells + column);
}

// The integral over each cell of a function of direction; `points` per side of a cell.
template <typename Function>
std::vector<double> integrate_cells(const Function& function, int points = 64) {
    std::vector<double> integrals(direction_cells, 0.0);
    const int rows = polar_cells * points;
    const int columns = angle_cells * points;
    const double ring = std::numbers::pi / rows;
    const double sector = 2.0 * std::numbers::pi / columns;
    for (int j = 0; j < columns; ++j) {
        const double phi = (j + 0.5) * sector;
        const float x = static_cast<float>(std::cos(phi));
        const float y = static_cast<float>(std::sin(phi));
        // Each column has its own offset, by the golden ratio.
        const double turns = (j + 0.5) * std::numbers::phi;
        const double offset = turns - std::floor(turns);
        for (int i = 0; i < rows; ++i) {
            const double theta = (i + offset) * ring;
            const double sine = std::sin(theta);
            const glm::vec3 w{static_cast<float>(sine) * x, static_cast<float>(sine) * y,
                              static_cast<float>(std::cos(theta))};
            integrals[static_cast<std::size_t>((i / points) * angle_cells + j / points)] +=
                ring * sector * sine * static_cast<double>(function(w));
        }
    }
    return integrals;
}

inline double total(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum;
}

// Counts of sampled directions by cell, where the last cell is for delta samples and for no sample. Also the moments of
// the red weight of all samples that are not delta (0 for no sample).
struct Sampled {
    std::vector<double> counts = std::vector<double>(direction_cells + 1, 0.0);
    Moments weight;
};

// If `power` is not 1, it is the planted skew.
inline Sampled draw(const tracer::Bsdf& bsdf, const glm::vec3& wo, std::size_t samples, std::uint32_t seed,
                    float power = 1.0f) {
    Uniform uniform(seed);
    Sampled result;
    for (std::size_t i = 0; i < samples; ++i) {
        const float lobe = uniform();
        glm::vec2 u{uniform(), 0.0f};
        u.y = uniform();
        if (power != 1.0f)
            u = {std::min(std::pow(u.x, power), 0x1.fffffep-1f), std::min(std::pow(u.y, power), 0x1.fffffep-1f)};
        const std::optional<tracer::BsdfSample> sample = bsdf.sample(wo, lobe, u);
        const bool counts = sample && !sample->delta;
        result.counts[counts ? direction_cell(sample->wi) : direction_cells] += 1.0;
        result.weight.add(counts ? static_cast<double>(sample->weight.x) : 0.0);
    }
    return result;
}

// χ² of the directions against `integrals` of the pdf, times `scale`: 1, or the planted defect of the pdf.
inline double direction_p_value(const Sampled& sampled, const std::vector<double>& integrals, double scale = 1.0) {
    const double samples = total(sampled.counts);
    std::vector<double> expected;
    for (const double integral : integrals) expected.push_back(samples * scale * integral);
    const double rest = 1.0 - scale * total(integrals);
    if (rest < -1e-5) return 0.0;  // a pdf that integrates to more than 1
    // Rounding may lose one sample in a million, at the horizon.
    expected.push_back(samples * std::max(1e-6, rest));
    return chi_squared_test(sampled.counts, expected).p_value;
}

inline glm::vec3 direction(double theta_degrees, double phi_degrees = 30.0) {
    const double theta = theta_degrees * std::numbers::pi / 180.0;
    const double phi = phi_degrees * std::numbers::pi / 180.0;
    return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::sin(theta) * std::sin(phi)),
            static_cast<float>(std::cos(theta))};
}

// The p-values of one BSDF seen from one direction, and of the same with defects of 1 %.
struct BsdfReport {
    double directions;         // sampled directions against the pdf
    double directions_skewed;  // the same with samples skewed by 1 %; 1 if this is not tested
    double directions_scaled;  // the same with the pdf scaled by 1.01
    double pdf_integral;       // at most 1
    double weight;             // mean weight against the integral of evaluate
    double weight_scaled;      // the same with evaluate scaled by 1.01
    double albedo;             // integral of evaluate
};

inline BsdfReport examine(const tracer::Bsdf& bsdf, const glm::vec3& wo, std::uint32_t seed, bool tries_skew = true) {
    const std::size_t samples = samples_to_detect(1e-4, direction_cells);
    const std::vector<double> pdf = integrate_cells([&](const glm::vec3& wi) { return bsdf.pdf(wo, wi); });
    const double albedo = total(integrate_cells([&](const glm::vec3& wi) { return bsdf.evaluate(wo, wi).x; }));
    const Sampled right = draw(bsdf, wo, samples, seed);
    // The quadrature of `albedo` is accurate to about 1e-5.
    return {direction_p_value(right, pdf),
            tries_skew ? direction_p_value(draw(bsdf, wo, samples, seed, 1.01f), pdf) : 1.0,
            direction_p_value(right, pdf, 1.01),
            total(pdf),
            mean_p_value(right.weight, albedo, 2e-5 * albedo),
            mean_p_value(right.weight, 1.01 * albedo, 2e-5 * albedo),
            albedo};
}

// The largest relative difference between what sample() returns for a direction and what pdf() and evaluate() return.
inline double worst_disagreement(const tracer::Bsdf& bsdf, const glm::vec3& wo, std::uint32_t seed) {
    Uniform uniform(seed);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const float lobe = uniform();
        const float first = uniform();
        const std::optional<tracer::BsdfSample> sample = bsdf.sample(wo, lobe, {first, uniform()});
        if (!sample || sample->delta) continue;
        const double pdf = static_cast<double>(bsdf.pdf(wo, sample->wi));
        const glm::vec3 value = bsdf.evaluate(wo, sample->wi);
        worst = std::max(worst, std::abs(pdf / static_cast<double>(sample->pdf) - 1.0));
        for (int channel = 0; channel < 3; ++channel) {
            const double weight = static_cast<double>(sample->weight[channel]);
            const double ratio = static_cast<double>(value[channel]) / pdf;
            worst = std::max(worst, std::abs(ratio - weight) / std::max(weight, 1e-3));
        }
    }
    return worst;
}

}  // namespace phasetree::tests
