// The project's own sine and cosine against the standard library's in double.
#include <doctest/doctest.h>

#include <cmath>

#include "math/dual.hpp"
#include "phasetree/math/number.hpp"
#include "support/random_tree.hpp"

namespace test_sine_cosine {

using namespace phasetree;
using phasetree::tests::Random;

namespace {

constexpr double ulp_of_one = 0x1p-23;

struct Worst {
    double error = 0;
    float at = 0;
    void look(float x) {
        const auto [s, c] = sine_cosine(x);
        const double exact = std::sin(static_cast<double>(x));
        const double e = std::max({std::abs(s - exact), std::abs(c - std::cos(static_cast<double>(x))),
                                   std::abs(static_cast<double>(sine(x)) - exact)});
        if (!(e <= error)) {
            error = e;
            at = x;
        }
    }
};

}  // namespace

TEST_CASE("sine and cosine are within the stated error up to 10⁴") {
    Worst worst;
    Random rng(8);
    const int n = tests::long_tests() ? 100'000'000 : 1'000'000;
    for (int i = 0; i < n; ++i) worst.look(rng.uniform(-1e4f, 1e4f));
    // All floats near each multiple of π/4, where quadrants change and one of the two vanishes.
    for (int k = -12732; k <= 12732; ++k) {
        float x = static_cast<float>(k * 0.78539816339744831);
        for (int step = 0; step < 4; ++step) {
            worst.look(x);
            x = std::nextafter(x, 1e9f);
        }
    }
    for (const float x : {0.f, -0.f, 1e-30f, -1e-30f, 1e4f, -1e4f}) worst.look(x);
    MESSAGE("largest error: ", worst.error / ulp_of_one, " ulp of 1, at ", worst.at);
    CHECK(worst.error < 2 * ulp_of_one);
}

TEST_CASE("sine and cosine lie on the unit circle, and never beyond by more than rounding") {
    // What a twist does to lengths.
    Random rng(9);
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto [s, c] = sine_cosine(rng.uniform(-1e4f, 1e4f));
        worst = std::max(worst, std::abs(std::hypot(static_cast<double>(s), static_cast<double>(c)) - 1));
    }
    CHECK(worst < 2 * ulp_of_one);
}

TEST_CASE("their derivatives are each other") {
    Random rng(10);
    for (int i = 0; i < 100'000; ++i) {
        const float x = rng.uniform(-100, 100);
        const auto [s, c] = sine_cosine(Dual(x, 1, 0, 0));
        REQUIRE(std::abs(sine(Dual(x, 1, 0, 0)).gradient().x - std::cos(static_cast<double>(x))) < 5e-6);
        REQUIRE(std::abs(s.gradient().x - std::cos(static_cast<double>(x))) < 5e-6);
        REQUIRE(std::abs(c.gradient().x + std::sin(static_cast<double>(x))) < 5e-6);
    }
}

}  // namespace test_sine_cosine
