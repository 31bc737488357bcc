#include "output/quantise.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace test_quantise {

using namespace phasetree::tracer;

TEST_CASE("thresholds lie inside (0, 1), all of them, and evenly in every neighbourhood") {
    std::set<float> levels;
    double worst = 0.0;
    for (int by = 0; by < 16; ++by) {
        for (int bx = 0; bx < 16; ++bx) {
            double sum = 0.0;
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 16; ++x) {
                    const float u = dither_threshold(16 * bx + x, 16 * by + y);
                    levels.insert(u);
                    sum += u;
                }
            }
            worst = std::max(worst, std::abs(sum / 256.0 - 0.5));
        }
    }
    CHECK(*levels.begin() == 1.0f / 512.0f);
    CHECK(*levels.rbegin() == 511.0f / 512.0f);
    CHECK(levels.size() == 256);
    // 256 independent thresholds have a mean off by 1/sqrt(12 · 256) = 0.018 in the standard deviation; the worst of
    // 256 such blocks would be near 0.05. An even cover does better than that.
    CHECK(worst < 0.015);
}

TEST_CASE("dithering keeps the mean of a value between two codes") {
    for (const float value : {10.1f, 100.25f, 187.516f, 200.9f}) {
        const std::vector<glm::vec3> pixels(64 * 64, glm::vec3(value / 255.0f));
        const auto codes = quantise8(pixels, 64, 5, 7);
        const double mean = std::accumulate(codes.begin(), codes.end(), 0.0) / static_cast<double>(codes.size());
        CHECK(std::abs(mean - value) < 2.0 / 256.0);
    }
}

TEST_CASE("codes stay codes, black black and white white") {
    for (int code = 0; code < 256; ++code) {
        // Half a thousandth of a code off, far more than the rounding of any display transform.
        for (const float error : {-0.0005f, 0.0f, 0.0005f}) {
            const std::vector<glm::vec3> pixels(32 * 32, glm::vec3((static_cast<float>(code) + error) / 255.0f));
            for (const int result : quantise8(pixels, 32, 0, 0)) REQUIRE(result == code);
        }
        const std::vector<glm::vec3> one{glm::vec3(static_cast<float>(code * 257) / 65535.0f)};
        CHECK(quantise16(one)[0] == code * 257);
    }
}

TEST_CASE("what no code can say is clamped, and no number is black") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec3> pixels{{-1.0f, 2.0f, std::nanf("")}, {-infinity, infinity, -0.0f}};
    for (int x = 0; x < 50; ++x) {
        CHECK(quantise8(pixels, 2, x, 3) == std::vector<std::uint8_t>{0, 255, 0, 0, 255, 0});
    }
    CHECK(quantise16(pixels) == std::vector<std::uint16_t>{0, 65535, 0, 0, 65535, 0});
}

}  // namespace test_quantise
