// The angle of a direction, against the standard library in double.
#include "phasetree/math/arc_tangent.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace test_arc_tangent {

using namespace phasetree;

TEST_CASE("angles are within the stated error all around, at any length") {
    constexpr double ulp_of_pi = 0x1p-22;
    double worst = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const double a = (i - 499'999.5) * 1e-6 * 6.283185307179586, length = std::exp2(i % 120 - 60);
        const float x = static_cast<float>(length * std::cos(a)), y = static_cast<float>(length * std::sin(a));
        const double expected = std::atan2(static_cast<double>(y), static_cast<double>(x));
        worst = std::max(worst, std::abs(static_cast<double>(angle_of(x, y)) - expected));
    }
    MESSAGE("largest error: ", worst / ulp_of_pi, " ulp of π");
    CHECK(worst < 3 * ulp_of_pi);
    CHECK(angle_of(0.f, 0.f) == 0);
    CHECK(angle_of(1.f, 0.f) == 0);
    CHECK(angle_of(0.f, 1.f) == doctest::Approx(1.5707963267948966));
    CHECK(angle_of(0.f, -1.f) == doctest::Approx(-1.5707963267948966));
    CHECK(angle_of(-1.f, 0.f) == doctest::Approx(3.141592653589793));
}

}  // namespace test_arc_tangent
