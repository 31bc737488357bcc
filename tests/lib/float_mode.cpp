// Subnormal numbers count as zero during the lifetime of a FlushSubnormals, and keep their values before and after it.
#include "phasetree/math/float_mode.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace test_float_mode {

using phasetree::FlushSubnormals;

namespace {

// Volatile, so that the compiler computes neither of them.
float half_of_least_normal() {
    volatile float least = std::numeric_limits<float>::min(), half = 0.5f;
    return least * half;
}
float twice(float x) {
    volatile float operand = x;
    return operand + operand;
}

}  // namespace

TEST_CASE("subnormal numbers are zero within FlushSubnormals, as operands and as results") {
    const float least = std::numeric_limits<float>::denorm_min();
    CHECK(half_of_least_normal() > 0);
    CHECK(twice(least) > 0);
    {
        const FlushSubnormals flush;
        const float result = half_of_least_normal(), of_operand = twice(least);
        CHECK(result == 0);
        CHECK(of_operand == 0);
        { const FlushSubnormals within; }
        const float still = half_of_least_normal();
        CHECK(still == 0);
    }
    CHECK(half_of_least_normal() > 0);
    CHECK(twice(least) > 0);
}

}  // namespace test_float_mode
