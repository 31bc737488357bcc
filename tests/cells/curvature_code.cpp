// Curvature bounds encoded in eight bits are never smaller than the original bounds, and at most an eighth larger.
#include "cells/curvature_code.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/uniform.hpp"

namespace test_curvature_code {

using phasetree::cells::CurvatureCode;
using phasetree::kernel::Curvature;

TEST_CASE("an encoded curvature bound is at least the bound, and at most an eighth larger") {
    phasetree::tests::Uniform random(1);
    for (const float diagonal : {0.01f, 1.0f, 37.0f}) {
        const CurvatureCode code(diagonal);
        for (int i = 0; i < 10000; ++i) {
            // The codes range from about 2⁻¹⁰, the smallest bound that has its own code, to 2²¹.
            const float bound = std::exp2(-10 + 30 * random()) / diagonal;
            const float decoded = code.decode(code.encode(bound));
            REQUIRE(decoded >= bound);
            REQUIRE(decoded <= 1.1251f * bound);
        }
        CHECK(code.decode(code.encode(1e-6f / diagonal)) >= 1e-6f / diagonal);
    }
}

TEST_CASE("flat and unknown curvature have their own codes") {
    const CurvatureCode code(2);
    CHECK(code.encode(0) == 0);
    CHECK(code.encode(-1) == 0);
    CHECK(code.decode(0) == 0);
    CHECK(code.encode(Curvature::unknown) == CurvatureCode::unknown);
    CHECK(code.encode(1e30f) == CurvatureCode::unknown);
    CHECK(code.encode(std::numeric_limits<float>::quiet_NaN()) == CurvatureCode::unknown);
    CHECK(code.decode(CurvatureCode::unknown) == Curvature::unknown);
}

}  // namespace test_curvature_code
