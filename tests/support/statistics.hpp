// Hypothesis tests for Monte Carlo code.
//
// A test compares a p-value (the probability that a correct program gives a result at least as far off) with a
// significance. A whole file's significance is shared among its tests by sidak(): with 1e-4 for the file, a correct
// program with a freshly drawn seed fails one run in 10,000; with the fixed seeds used here it never does.
//
//     Moments moments;
//     for (...) moments.add(estimate);
//     CHECK(mean_p_value(moments, expected) > sidak(1e-4, number_of_tests));
//
//     CHECK(chi_squared_test(observed, expected).p_value > sidak(1e-4, number_of_tests));
//
// References: incomplete gamma function, Abramowitz & Stegun, Handbook of Mathematical Functions, 6.5.29 (series) and
// 6.5.31 (continued fraction, evaluated by Lentz's method); Šidák, J. Amer. Stat. Assoc. 62 (1967), 626-633;
// Welford, Technometrics 4 (1962), 419-420 (running moments).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

namespace phasetree::tests {

// Q(a, x) = Γ(a, x) / Γ(a), the upper regularised incomplete gamma function; a > 0, x ≥ 0.
inline double upper_incomplete_gamma(double a, double x) {
    if (!(a > 0.0)) throw std::invalid_argument("upper_incomplete_gamma: a must be positive");
    if (!(x > 0.0)) return 1.0;
    if (std::isinf(x)) return 0.0;
    constexpr double epsilon = 1e-15;
    constexpr int most_terms = 100000;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (int n = 1; n < most_terms && term > sum * epsilon; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return std::clamp(1.0 - front * sum, 0.0, 1.0);
    }
    constexpr double tiny = 1e-300;
    double b = x + 1.0 - a;
    double c = 1.0 / tiny;
    double d = 1.0 / b;
    double fraction = d;
    for (int n = 1; n < most_terms; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        if (std::abs(d) < tiny) d = tiny;
        c = b + numerator / c;
        if (std::abs(c) < tiny) c = tiny;
        d = 1.0 / d;
        const double change = d * c;
        fraction *= change;
        if (std::abs(change - 1.0) < epsilon) break;
    }
    return std::clamp(front * fraction, 0.0, 1.0);
}

// P(X ≥ statistic) for X distributed as χ² with the given degrees of freedom.
inline double chi_squared_survival(double statistic, double degrees_of_freedom) {
    if (std::isnan(statistic)) return 0.0;  // a broken statistic is never accepted
    return upper_incomplete_gamma(0.5 * degrees_of_freedom, 0.5 * statistic);
}

// P(|Z| ≥ |z|) for a standard normal Z.
inline double normal_two_sided(double z) {
    if (std::isnan(z)) return 0.0;
    return std::erfc(std::abs(z) / std::sqrt(2.0));
}

// The significance for each of `tests` independent tests, so that all together have `significance`.
inline double sidak(double significance, std::size_t tests) {
    return -std::expm1(std::log1p(-significance) / static_cast<double>(std::max<std::size_t>(tests, 1)));
}

// Mean and variance of a stream of numbers.
class Moments {
  public:
    void add(double value) {
        ++count_;
        const double difference = value - mean_;
        mean_ += difference / static_cast<double>(count_);
        squares_ += difference * (value - mean_);
    }

    std::size_t count() const { return count_; }
    double mean() const { return mean_; }
    // Unbiased sample variance.
    double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0.0; }
    double standard_error() const {
        return count_ > 0 ? std::sqrt(variance() / static_cast<double>(count_))
                          : std::numeric_limits<double>::infinity();
    }

  private:
    std::size_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

// z-test: the two-sided p-value of `moments` having the mean `expected`. For independent samples, and enough of them
// (hundreds) that their mean is normal. `rounding` is how far the mean may be off by arithmetic alone.
inline double mean_p_value(const Moments& moments, double expected, double rounding = 0.0) {
    const double off = std::max(0.0, std::abs(moments.mean() - expected) - rounding);
    if (std::isnan(moments.mean())) return 0.0;
    if (off == 0.0) return 1.0;
    const double error = moments.standard_error();
    return error > 0.0 ? normal_two_sided(off / error) : 0.0;
}

struct ChiSquared {
    double statistic = 0.0;
    double degrees_of_freedom = 0.0;
    double p_value = 1.0;
};

// Pearson's χ² test that counts `observed` come from the expected counts `expected`. Give every sample a cell (a last
// cell for "absorbed" or "elsewhere"), so that both sum to the same total. Cells expecting fewer than `smallest` are
// pooled, smallest first. A count where (next to) nothing can be, less than 1e-7 expected, gives p = 0.
inline ChiSquared chi_squared_test(std::span<const double> observed, std::span<const double> expected,
                                   double smallest = 5.0) {
    if (observed.size() != expected.size()) throw std::invalid_argument("chi_squared_test: sizes differ");
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });

    ChiSquared result;
    std::size_t cells = 0;
    double pooled_observed = 0.0;
    double pooled_expected = 0.0;
    const auto close_pool = [&] {
        const double difference = pooled_observed - pooled_expected;
        result.statistic += difference * difference / pooled_expected;
        ++cells;
        pooled_observed = pooled_expected = 0.0;
    };
    for (const std::size_t cell : order) {
        const bool impossible = !(expected[cell] >= 0.0) || (expected[cell] < 1e-7 && observed[cell] > 0.0);
        if (impossible) return {std::numeric_limits<double>::infinity(), 1.0, 0.0};
        pooled_observed += observed[cell];
        pooled_expected += expected[cell];
        if (pooled_expected >= smallest) close_pool();
    }
    // Only when everything together expects fewer than `smallest` is anything left over.
    if (pooled_expected > 0.0) close_pool();
    if (cells < 2) return result;
    result.degrees_of_freedom = static_cast<double>(cells - 1);
    result.p_value = chi_squared_survival(result.statistic, result.degrees_of_freedom);
    return result;
}

// The number of samples that a χ² test needs to detect a defect of χ²-distance `distance` = Σ (q−p)²/p. The statistic
// then has mean N·distance + degrees and standard deviation about √(2·degrees + 4·N·distance). With `deviations` = 4
// for a significance near 1e-4 and 4 more for certainty, N·distance ≥ 8·√(2·degrees) + 64 is ample.
inline std::size_t samples_to_detect(double distance, double degrees_of_freedom) {
    return static_cast<std::size_t>((8.0 * std::sqrt(2.0 * degrees_of_freedom) + 64.0) / distance) + 1;
}

}  // namespace phasetree::tests
