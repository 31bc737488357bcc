// Phase functions: normalised, sampled exactly, with the mean cosine that they state.
#include "media/phase_function.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/statistics.hpp"
#include "support/uniform.hpp"
#include "tracer/support/phase_function_equations.hpp"

namespace test_phase_functions {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

struct Named {
    std::string name;
    PhaseFunction phase;
    double precision = 1e-6;  // of the integral; less where floats round off the peak of Henyey and Greenstein's
};

std::vector<Named> all() {
    const HenyeyGreenstein forwards(0.8f), backwards(-0.3f);
    return {{"isotropic", HenyeyGreenstein(0.0f)},
            {"forward", HenyeyGreenstein(0.9f), 2e-5},
            {"backward", HenyeyGreenstein(-0.6f)},
            {"Rayleigh", Rayleigh()},
            {"Draine", Draine(0.5f, 2.0f)},
            {"Draine, forward", Draine(0.93f, 30.0f)},
            {"Draine, most forward", Draine(0.99f, 1000.0f)},
            {"Draine, backward", Draine(-0.4f, 5.0f)},
            {"Draine, most backward", Draine(-0.99f, 0.5f)},
            {"Draine, without g", Draine(0.0f, 7.0f)},
            {"Draine, little g", Draine(0.002f, 1.0f)},
            {"small droplets", Droplets(5.0f)},
            {"large droplets", Droplets(50.0f)},
            {"mix", MixedPhaseFunction(forwards, backwards, 0.3f)},
            {"mix, first only", MixedPhaseFunction(forwards, backwards, 0.0f), 2e-6},
            {"mix, second only", MixedPhaseFunction(forwards, backwards, 1.0f)},
            {"mix of mixes",
             MixedPhaseFunction(Droplets(10.0f), MixedPhaseFunction(Rayleigh(), Draine(0.7f, 1.0f), 0.5f), 0.6f)}};
}

// The distribution of the cosine μ, by Simpson's rule. All nodes are floats, and they are dense near both poles: 1 −
// |μ| increases in steps of 2⁻²⁴ at first, and by 1/2048 of itself later.
class Distribution {
  public:
    explicit Distribution(const PhaseFunction& phase) {
        std::vector<double> heights{0};  // 1 − |μ|
        for (double step = 0x1p-24; heights.back() < 1;) {
            if (heights.back() >= 4096 * step) step *= 2;
            heights.push_back(heights.back() + step);
        }
        for (std::size_t i = 0; i + 2 < heights.size(); i += 2) add(phase, heights[i], heights[i + 2]);
        for (std::size_t i = heights.size() - 1; i >= 2; i -= 2) add(phase, 2 - heights[i], 2 - heights[i - 2]);
    }
    double total() const { return cumulative_.back(); }
    double mean() const { return mean_; }
    // The probability of a larger cosine than 1 − height.
    double before(double height) const {
        const auto after = std::upper_bound(heights_.begin() + 1, heights_.end() - 1, height);
        const auto i = static_cast<std::size_t>(after - heights_.begin());
        const double t = (height - heights_[i - 1]) / (heights_[i] - heights_[i - 1]);
        return cumulative_[i - 1] + t * (cumulative_[i] - cumulative_[i - 1]);
    }

  private:
    void add(const PhaseFunction& phase, double from, double to) {
        const auto p = [&](double height) {
            return 2 * std::numbers::pi * static_cast<double>(phase.evaluate(static_cast<float>(1 - height)));
        };
        const double middle = 0.5 * (from + to), a = p(from), b = 4 * p(middle), c = p(to);
        cumulative_.push_back(cumulative_.back() + (to - from) / 6 * (a + b + c));
        heights_.push_back(to);
        mean_ += (to - from) / 6 * ((1 - from) * a + (1 - middle) * b + (1 - to) * c);
    }

    std::vector<double> heights_{0}, cumulative_{0};
    double mean_ = 0;
};

// 1 − z without the rounding of z, of which a narrow peak has little.
double below_pole(const glm::vec3& w) {
    const double x = static_cast<double>(w.x), y = static_cast<double>(w.y), sine2 = x * x + y * y;
    if (std::abs(w.z) < 0.9f) return 1 - static_cast<double>(w.z);
    const double height = sine2 / (1 + std::sqrt(std::max(0.0, 1 - sine2)));
    return w.z > 0.0f ? height : 2 - height;
}

// p-values of χ² tests of one set of samples: of the cosine in 64 cells of equal probability, and of cosine and azimuth
// together in 8 × 8. Each also with a planted error: a power of 1.01 of one distribution, a χ²-distance of 1e-4.
struct Tested {
    double cosine, both, wrong_cosine, wrong_azimuth;
};

Tested tested(const PhaseFunction& phase, const Distribution& distribution) {
    constexpr std::size_t cells = 64, across = 8;
    constexpr double planted = 1.01;
    const std::size_t count = samples_to_detect(1e-4, cells - 1);
    const std::vector<double> none(cells), expected(cells, static_cast<double>(count) / cells);
    std::vector<double> cosine = none, both = none, wrong_cosine = none, wrong_azimuth = none;
    const auto cell = [](double share, std::size_t number) {
        return std::min(static_cast<std::size_t>(share * static_cast<double>(number)), number - 1);
    };
    Uniform random(3);
    for (std::size_t n = 0; n < count; ++n) {
        const glm::vec3 w = phase.sample(random.two());
        const double share = distribution.before(below_pole(w)) / distribution.total();
        const double angle = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * std::numbers::pi);
        const double turn = angle < 0 ? angle + 1 : angle;
        ++cosine[cell(share, cells)];
        ++both[cell(share, across) * across + cell(turn, across)];
        ++wrong_cosine[cell(std::pow(share, planted), cells)];
        ++wrong_azimuth[cell(share, across) * across + cell(std::pow(turn, planted), across)];
    }
    const auto p_value = [&](const std::vector<double>& observed) {
        return chi_squared_test(observed, expected).p_value;
    };
    return {p_value(cosine), p_value(both), p_value(wrong_cosine), p_value(wrong_azimuth)};
}

}  // namespace

TEST_CASE("phase functions integrate to 1, and have the mean cosine that they state") {
    for (const auto& [name, phase, precision] : all()) {
        CAPTURE(name);
        const Distribution distribution(phase);
        CHECK(std::abs(distribution.total() - 1) < precision);
        CHECK(std::abs(distribution.mean() - static_cast<double>(phase.mean_cosine())) < precision);
    }
}

TEST_CASE("phase functions are sampled exactly, and an error of 1 % of the distribution is found") {
    const auto kinds = all();
    const double significance = sidak(1e-4, 2 * kinds.size());
    for (const auto& [name, phase, precision] : kinds) {
        CAPTURE(name);
        const Tested p = tested(phase, Distribution(phase));
        CHECK(p.cosine > significance);
        CHECK(p.both > significance);
        CHECK(p.wrong_cosine < significance);
        CHECK(p.wrong_azimuth < significance);
    }
}

TEST_CASE("phase functions have the values of their equations") {
    for (const double mu : {-1.0, -0.5, 0.0, 0.25, 0.75, 1.0}) {
        const auto is_close = [&](const PhaseFunction& phase, double expected, double precision = 2e-6) {
            CHECK(static_cast<double>(phase.evaluate(static_cast<float>(mu))) ==
                  doctest::Approx(expected).epsilon(precision));
        };
        is_close(HenyeyGreenstein(0.5f), draine_density(0.5, 0, mu));
        is_close(Rayleigh(), draine_density(0, 1, mu));
        is_close(Draine(-0.25f, 3), draine_density(-0.25, 3, mu));
        is_close(Draine(0.7f, 0), draine_density(static_cast<double>(0.7f), 0, mu));
        is_close(Droplets(10), droplets_density(10, mu), 2e-5);  // the parameters are floats
        is_close(MixedPhaseFunction(HenyeyGreenstein(0.5f), Rayleigh(), 0.25f),
                 0.75 * draine_density(0.5, 0, mu) + 0.25 * draine_density(0, 1, mu));
    }
}

TEST_CASE("Draine's includes Henyey and Greenstein's and Rayleigh's") {
    Uniform random(4);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 u = random.two();
        CHECK(Draine(0.7f, 0.0f).sample(u).z == doctest::Approx(HenyeyGreenstein(0.7f).sample(u).z).epsilon(1e-4));
        CHECK(Draine(0.0f, 1.0f).sample(u).z == doctest::Approx(Rayleigh().sample(u).z).epsilon(1e-4));
    }
}

TEST_CASE("larger droplets scatter more light forwards") {
    float before = 0;
    for (const float diameter : {5.0f, 8.0f, 14.0f, 25.0f, 50.0f}) {
        const float g = Droplets(diameter).mean_cosine();
        CHECK(g > before);
        CHECK(g > 0.75f);
        CHECK(g < 0.9f);
        before = g;
    }
}

TEST_CASE("the extreme random numbers give unit vectors") {
    for (const auto& [name, phase, precision] : all())
        for (const float x : {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f})
            for (const float y : {0.0f, 0.25f, 0x1.fffffep-1f}) {
                CAPTURE(name);
                CHECK(glm::length(phase.sample({x, y})) == doctest::Approx(1).epsilon(1e-5));
            }
}

}  // namespace test_phase_functions
