// Shared code of the tests of lights: random numbers, χ² tests of directions and z-tests of estimators. Each test is
// run once without and once with a planted defect of 1 %, which must be detected.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "lights/lat_long.hpp"
#include "support/statistics.hpp"
#include "support/uniform.hpp"

namespace phasetree::tests {

// A p-value below this counts as wrong. With about 40 tests in a file, a correct program fails for one in 2,500 choices
// of the seeds, and the seeds are fixed.
inline constexpr double significance = 1e-5;

// The probability of each of columns × rows lat-long bins under a density per steradian, by the midpoint rule on a grid
// that is `finer` times finer (exact when the density is constant on that grid).
template <class Density>
std::vector<double> lat_long_probabilities(int columns, int rows, int finer, const Density& density) {
    std::vector<double> probability(static_cast<std::size_t>(columns * rows), 0.0);
    const int width = columns * finer;
    const int height = rows * finer;
    for (int j = 0; j < height; ++j) {
        const double top = std::cos(std::numbers::pi * j / height);
        const double bottom = std::cos(std::numbers::pi * (j + 1) / height);
        const double solid_angle = 2.0 * std::numbers::pi / width * (top - bottom);
        for (int i = 0; i < width; ++i) {
            const double azimuth = 2.0 * std::numbers::pi * ((i + 0.5) / width - 0.5);
            const double value = density(tracer::direction_of(azimuth, 0.5 * (top + bottom)));
            probability[static_cast<std::size_t>((j / finer) * columns + i / finer)] += solid_angle * value;
        }
    }
    return probability;
}

inline int lat_long_bin(int columns, int rows, const glm::vec3& direction) {
    const glm::vec2 uv = tracer::lat_long_of(direction);
    const int column = std::min(static_cast<int>(uv.x * static_cast<float>(columns)), columns - 1);
    const int row = std::min(static_cast<int>(uv.y * static_cast<float>(rows)), rows - 1);
    return row * columns + column;
}

inline double sum_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum;
}

struct PValues {
    double correct;
    double defect;
};

// χ² test of sampled directions. `sample(u)` gives an optional direction, `bin(direction)` its cell or -1. The defect
// draws 1 % of the samples from only half of the unit square; its χ²-distance is 0.01² = 1e-4 or more. The number of
// samples is large enough to detect it.
template <class Sample, class Bin>
PValues direction_test(const std::vector<double>& probability, const Sample& sample, const Bin& bin) {
    const std::size_t cells = probability.size();
    const std::size_t count = samples_to_detect(1e-4, static_cast<double>(cells));
    std::vector<double> expected(cells + 1, 0.0);
    for (std::size_t i = 0; i < cells; ++i) expected[i] = probability[i] * static_cast<double>(count);
    std::vector<double> observed(cells + 1, 0.0);
    std::vector<double> defective(cells + 1, 0.0);
    const auto cell_of = [&](const glm::vec2& u) {
        const std::optional<glm::vec3> direction = sample(u);
        const int cell = direction ? bin(*direction) : -1;
        return cell < 0 ? cells : static_cast<std::size_t>(cell);
    };
    Uniform random(1);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec2 u = random.two();
        const std::size_t cell = cell_of(u);
        observed[cell] += 1.0;
        defective[random() < 0.01f ? cell_of({u.x, 0.5f * u.y}) : cell] += 1.0;
    }
    return {chi_squared_test(observed, expected).p_value, chi_squared_test(defective, expected).p_value};
}

// Cells of equal solid angle in the cone around a unit axis with 1 − cos α = height: equal steps of the squared chord
// |ω − axis|² = 2(1 − cos θ) and of the angle around the axis. A direction stored in single precision is off by up to
// 1e-7, so one at the rim may lie outside by a few times that; it counts as inside.
class ConeBins {
  public:
    static constexpr int rings = 8;
    static constexpr int sectors = 8;
    static constexpr int count = rings * sectors;

    ConeBins(const glm::dvec3& axis, double height)
        : axis_(axis),
          first_(glm::normalize(glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0)))),
          second_(glm::cross(axis, first_)),
          rim_(std::sqrt(2.0 * height)) {}

    int operator()(const glm::vec3& direction) const {
        const glm::dvec3 chord = glm::dvec3(direction) - axis_;
        const double length = glm::length(chord);
        if (length > rim_ + 3e-7) return -1;
        const int ring = static_cast<int>(rings * length * length / (rim_ * rim_));
        const double angle = std::atan2(glm::dot(chord, second_), glm::dot(chord, first_)) / (2.0 * std::numbers::pi);
        const int sector = static_cast<int>((angle + 0.5) * sectors);
        return std::min(ring, rings - 1) * sectors + std::min(sector, sectors - 1);
    }

  private:
    glm::dvec3 axis_, first_, second_;
    double rim_;
};

// The mean of an estimator must be `expected`, and precise enough to detect an error of 1 %.
struct EstimatorResult {
    double p_value;
    double p_value_of_defect;
    double relative_error;
};

template <class Estimate>
EstimatorResult estimator_test(double expected, std::size_t count, const Estimate& estimate, std::uint32_t seed = 1) {
    Moments moments;
    Moments defective;
    Uniform random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const double value = estimate(random);
        moments.add(value);
        defective.add(1.01 * value);
    }
    // 2e-6 for single-precision arithmetic: about thirty rounding errors of 6e-8.
    const double rounding = 2e-6 * std::abs(expected);
    return {mean_p_value(moments, expected, rounding), mean_p_value(defective, expected, rounding),
            moments.mean() / expected - 1.0};
}

inline void check(const EstimatorResult& result) {
    CAPTURE(result.relative_error);
    CHECK(result.p_value > significance);
    CHECK(result.p_value_of_defect < significance);
}

template <class Sample, class Bin>
void check_directions(const std::vector<double>& probability, const Sample& sample, const Bin& bin) {
    const PValues result = direction_test(probability, sample, bin);
    CHECK(result.correct > significance);
    CHECK(result.defect < significance);
}

}  // namespace phasetree::tests
