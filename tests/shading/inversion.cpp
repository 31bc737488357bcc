#include "sampling/inversion.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "bsdf_checks.hpp"

namespace test_inversion {

using namespace phasetree::tracer;
using phasetree::tests::Uniform;

TEST_CASE("inversion: finds the interval that a linear search finds, and skips empty ones") {
    Uniform uniform(71);
    for (const std::size_t intervals : {1u, 2u, 3u, 7u, 64u, 100u, 511u}) {
        CAPTURE(intervals);
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<double> weights(intervals);
            for (double& w : weights) w = uniform() < 0.4f ? 0.0 : static_cast<double>(uniform());
            weights[static_cast<std::size_t>(trial) % intervals] = 1.0;
            std::vector<float> cumulative(intervals + 1);
            double sum = 0;
            for (const double w : weights) sum += w;
            CHECK(accumulate(weights, cumulative) == doctest::Approx(sum));
            REQUIRE(cumulative.front() == 0.0f);
            REQUIRE(cumulative.back() == 1.0f);
            std::vector<float> samples{0.0f, 0x1p-24f, 0x1.fffffep-1f, 1.0f};
            for (const float boundary : cumulative) samples.push_back(boundary);
            for (int i = 0; i < 200; ++i) samples.push_back(uniform());
            for (const float u : samples) {
                CAPTURE(u);
                const Inverse found = invert(cumulative, u);
                const float inside = std::min(u, 0x1.fffffep-1f);
                std::size_t expected = 0;
                while (!(inside < cumulative[expected + 1])) ++expected;
                CHECK(found.index == expected);
                CHECK(weights[found.index] > 0.0);
                CHECK(found.position >= 0.0f);
                CHECK(found.position < 1.0f);
                const float back =
                    cumulative[expected] + found.position * (cumulative[expected + 1] - cumulative[expected]);
                CHECK(back == doctest::Approx(inside).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("inversion: what is no number, or out of range, is in some interval") {
    const std::vector<float> cumulative{0.0f, 0.25f, 1.0f};
    for (const float u : {std::numeric_limits<float>::quiet_NaN(), -1.0f, 2.0f, std::numeric_limits<float>::infinity()})
        CHECK(invert(cumulative, u).index < 2);
}

}  // namespace test_inversion
