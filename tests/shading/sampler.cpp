#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "sampling/sobol.hpp"
#include "support/statistics.hpp"

namespace test_sampler {

using namespace phasetree::tests;
using phasetree::tracer::nested_uniform_scramble;
using phasetree::tracer::Sampler;
using phasetree::tracer::sobol_first;
using phasetree::tracer::sobol_second;

TEST_CASE("Sobol': the second dimension equals its direction numbers") {
    for (std::uint32_t n = 0; n < 5000; ++n) {
        const std::uint32_t index = n * 2654435761u;
        std::uint32_t expected = 0;
        std::uint32_t v = 1u << 31;
        for (std::uint32_t i = index; i != 0; i >>= 1, v ^= v >> 1) {
            if (i & 1u) expected ^= v;
        }
        const bool same = sobol_second(index) == expected;
        CHECK(same);
        if (!same) break;
    }
    CHECK(sobol_first(1u) == 0x80000000u);
    CHECK(sobol_first(6u) == 0x60000000u);
}

TEST_CASE("Owen scrambling: a bit depends on the bits above it only, and on all of them") {
    for (std::uint32_t bit = 1; bit < 32; ++bit) {
        bool upper_kept = true;
        int lower_changed = 0;
        for (std::uint32_t i = 0; i < 200; ++i) {
            const std::uint32_t x = i * 2654435761u;
            const std::uint32_t seed = i * 40503u + 7u;
            const std::uint32_t change =
                nested_uniform_scramble(x, seed) ^ nested_uniform_scramble(x ^ (1u << bit), seed);
            upper_kept = upper_kept && (change >> bit) == 1u;
            if (bit > 4 && (change & 1u << (bit - 1))) ++lower_changed;
        }
        CHECK(upper_kept);
        if (bit > 4) {
            CHECK(lower_changed > 50);
            CHECK(lower_changed < 150);
        }
    }
}

TEST_CASE("sampler: numbers that are evenly spaced over a power of two of samples, and uniform over pixels") {
    for (const std::uint32_t count : {8u, 64u}) {
        std::vector<float> numbers;
        for (std::uint32_t i = 0; i < count; ++i) {
            Sampler sampler(17, 23, 3 * count + i, 4);
            sampler.next2();
            numbers.push_back(sampler.next_evenly());
        }
        std::ranges::sort(numbers);
        for (std::size_t i = 1; i < count; ++i)
            CHECK(numbers[i] - numbers[i - 1] == doctest::Approx(1.0f / static_cast<float>(count)).epsilon(1e-5));
    }
    double sum = 0, of_squares = 0;
    constexpr std::uint32_t pixels = 40000;
    for (std::uint32_t x = 0; x < pixels; ++x) {
        const double u = static_cast<double>(Sampler(x, 5, 11, 4).next_evenly());
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
        sum += u;
        of_squares += u * u;
    }
    // Five standard errors.
    CHECK(std::abs(sum / pixels - 0.5) < 5 * std::sqrt(1.0 / 12 / pixels));
    CHECK(std::abs(of_squares / pixels - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / pixels));
}

TEST_CASE("sampler: every aligned power of two of samples is a (0,m,2)-net") {
    for (std::uint32_t m = 1; m <= 10; ++m) {
        const std::uint32_t count = 1u << m;
        for (const std::uint32_t block : {0u, 1u, 5u}) {
            std::vector<glm::vec2> points;
            for (std::uint32_t i = 0; i < count; ++i) {
                Sampler sampler(17, 23, block * count + i, 4);
                sampler.next();  // the property must hold in any group, not only in the first
                sampler.next2();
                points.push_back(sampler.next2());
            }
            for (std::uint32_t a = 0; a <= m; ++a) {
                std::vector<int> hits(count, 0);
                for (const glm::vec2& p : points) {
                    const auto column = static_cast<std::uint32_t>(p.x * static_cast<float>(1u << a));
                    const auto row = static_cast<std::uint32_t>(p.y * static_cast<float>(1u << (m - a)));
                    ++hits[(row << a) + column];
                }
                CAPTURE(m);
                CAPTURE(a);
                CHECK(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
            }
        }
    }
}

TEST_CASE("sampler: one-dimensional numbers are stratified too") {
    std::vector<int> hits(256, 0);
    for (std::uint32_t i = 0; i < 256; ++i) {
        Sampler sampler(1, 2, 512 + i, 3);
        sampler.next2();
        ++hits[static_cast<std::size_t>(sampler.next() * 256.0f)];
    }
    CHECK(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
}

TEST_CASE("sampler: in [0, 1), never 1") {
    float least = 1.0f;
    float most = 0.0f;
    for (std::uint32_t i = 0; i < 300000; ++i) {
        Sampler sampler(i % 640, i / 640, i, 9);
        for (int d = 0; d < 4; ++d) {
            const glm::vec2 u = sampler.next2();
            least = std::min({least, u.x, u.y});
            most = std::max({most, u.x, u.y});
        }
    }
    CHECK(least >= 0.0f);
    CHECK(most < 1.0f);
    // Among 2.4 million multiples of 2⁻²⁴, some are in the last 0.0001 %.
    CHECK(least < 1e-5f);
    CHECK(most > 0.99999f);
}

TEST_CASE("sampler: over pixels and seeds, numbers are uniform and groups independent; 1 % of skew is seen") {
    // One sample per pixel, and a 16 × 16 histogram of two numbers: from one group, from different groups, from
    // neighbouring pixels. The skew u^1.01 is a χ²-distance of 1e-4 per coordinate.
    constexpr std::size_t cells = 16;
    const std::size_t samples = samples_to_detect(1e-4, cells * cells - 1);
    const double significance = sidak(1e-4, 3);
    std::array<std::vector<double>, 4> counts;
    for (auto& c : counts) c.assign(cells * cells, 0.0);
    const auto cell = [](float x, float y) {
        return static_cast<std::size_t>(x * cells) * cells + static_cast<std::size_t>(y * cells);
    };
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t x = i % 1920;
        const std::uint32_t y = i / 1920;
        Sampler sampler(x, y, i % 7, 1);
        const glm::vec2 first = sampler.next2();
        const float later = sampler.next();
        Sampler neighbour(x + 1, y, i % 7, 1);
        counts[0][cell(first.x, first.y)] += 1.0;
        counts[1][cell(first.x, later)] += 1.0;
        counts[2][cell(first.x, neighbour.next2().x)] += 1.0;
        counts[3][cell(std::min(std::pow(first.x, 1.01f), 0.9999999f), first.y)] += 1.0;
    }
    const std::vector<double> expected(cells * cells, static_cast<double>(samples) / (cells * cells));
    CHECK(chi_squared_test(counts[0], expected).p_value > significance);
    CHECK(chi_squared_test(counts[1], expected).p_value > significance);
    CHECK(chi_squared_test(counts[2], expected).p_value > significance);
    CHECK(chi_squared_test(counts[3], expected).p_value < significance);
}

TEST_CASE("sampler: estimates are unbiased and converge faster than random ones") {
    // ∫ x e^y over the square is (e − 1)/2.
    const double exact = 0.5 * (std::exp(1.0) - 1.0);
    const auto variance = [&](std::uint32_t count, Moments& moments) {
        for (std::uint32_t pixel = 0; pixel < 2000; ++pixel) {
            double sum = 0.0;
            for (std::uint32_t i = 0; i < count; ++i) {
                Sampler sampler(pixel, 3, i, 5);
                const glm::vec2 u = sampler.next2();
                sum += static_cast<double>(u.x) * std::exp(static_cast<double>(u.y));
            }
            moments.add(sum / count);
        }
        return moments.variance();
    };
    Moments few;
    Moments many;
    const double coarse = variance(16, few);
    const double fine = variance(256, many);
    // Truncation to 24 bits lowers every number by 2⁻²⁵ on average.
    CHECK(mean_p_value(few, exact, 1e-7) > sidak(1e-4, 2));
    CHECK(mean_p_value(many, exact, 1e-7) > sidak(1e-4, 2));
    CHECK(mean_p_value(few, 1.01 * exact, 1e-7) < sidak(1e-4, 2));
    CHECK(mean_p_value(many, 1.01 * exact, 1e-7) < sidak(1e-4, 2));
    // Random points: variance 0.327/N, a ratio of 16. The variance of scrambled nets tends towards N⁻³, a ratio of
    // 4096.
    CHECK(fine * 500.0 < coarse);
    CHECK(fine * 256.0 < 0.327 / 200.0);
}

TEST_CASE("sampler: a value depends on pixel, sample, seed and dimension only") {
    const auto value = [](std::uint32_t x, std::uint32_t y, std::uint32_t sample, std::uint32_t seed) {
        Sampler sampler(x, y, sample, seed);
        sampler.next();
        return sampler.next2().y;
    };
    const float reference = value(3, 4, 100, 7);
    value(9, 9, 1, 1);
    CHECK(value(3, 4, 100, 7) == reference);
    const std::set<float> all{reference, value(4, 3, 100, 7), value(3, 4, 101, 7), value(3, 4, 100, 8),
                              value(2, 4, 100, 7)};
    CHECK(all.size() == 5);
}

}  // namespace test_sampler
