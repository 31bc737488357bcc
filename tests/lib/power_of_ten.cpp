#include "phasetree_support/power_of_ten.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using phasetree::support::exponent_of_ten;

TEST_CASE("the exponent of ten changes exactly at powers of ten") {
    for (int exponent = -22; exponent <= 22; ++exponent) {
        CAPTURE(exponent);
        const double power = std::stod("1e" + std::to_string(exponent));
        CHECK(exponent_of_ten(power) == exponent);
        CHECK(exponent_of_ten(5 * power) == exponent);
        CHECK(exponent_of_ten(std::nextafter(power, 0)) == exponent - 1);
    }
    CHECK(exponent_of_ten(std::numeric_limits<double>::max()) == 308);
    CHECK(exponent_of_ten(std::numeric_limits<double>::min()) == -308);
}
