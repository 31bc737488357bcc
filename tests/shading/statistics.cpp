#include "support/statistics.hpp"

#include <doctest/doctest.h>

#include <array>

namespace test_statistics {

using namespace phasetree::tests;

TEST_CASE("statistics: tabulated values") {
    CHECK(chi_squared_survival(3.841459, 1) == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(chi_squared_survival(18.307038, 10) == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(chi_squared_survival(149.449253, 100) == doctest::Approx(1e-3).epsilon(1e-5));
    CHECK(chi_squared_survival(0.0, 5) == 1.0);
    CHECK(chi_squared_survival(2.0, 2) == doctest::Approx(std::exp(-1.0)));  // closed form for two degrees
    CHECK(normal_two_sided(1.959964) == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(sidak(0.05, 1) == doctest::Approx(0.05));
    CHECK(1.0 - std::pow(1.0 - sidak(1e-4, 20), 20.0) == doctest::Approx(1e-4));
}

TEST_CASE("statistics: moments") {
    Moments moments;
    for (const double x : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) moments.add(x);
    CHECK(moments.mean() == doctest::Approx(5.0));
    CHECK(moments.variance() == doctest::Approx(32.0 / 7.0));
    CHECK(moments.standard_error() == doctest::Approx(std::sqrt(4.0 / 7.0)));
    CHECK(mean_p_value(moments, 5.0) == 1.0);
    CHECK(mean_p_value(moments, 50.0) < 1e-9);
}

TEST_CASE("statistics: the test of counts") {
    const std::array<double, 4> observed{90.0, 110.0, 95.0, 105.0};
    const std::array<double, 4> expected{100.0, 100.0, 100.0, 100.0};
    const ChiSquared fair = chi_squared_test(observed, expected);
    CHECK(fair.statistic == doctest::Approx(2.5));
    CHECK(fair.degrees_of_freedom == 3.0);
    CHECK(fair.p_value == doctest::Approx(0.4752911).epsilon(1e-5));
    // Small cells are pooled: here into {1 + 2 + 3}, {50}.
    const std::array<double, 4> small{1.0, 2.0, 3.0, 50.0};
    CHECK(chi_squared_test(small, small).degrees_of_freedom == 1.0);
    // A count where the expected count is zero.
    const std::array<double, 2> impossible_observed{100.0, 10.0};
    const std::array<double, 2> impossible_expected{110.0, 0.0};
    CHECK(chi_squared_test(impossible_observed, impossible_expected).p_value < 1e-4);
    const std::array<double, 2> negative{110.0, -1.0};
    CHECK(chi_squared_test(impossible_observed, negative).p_value == 0.0);
}

}  // namespace test_statistics
