// Solids displaced by noise, whose cells know its slope and how it bends: rays must find what marching the whole finds.
#include <doctest/doctest.h>

#include "phasetree/phasetree.hpp"
#include "support/compared_crossings.hpp"

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("rays through cells of displaced solids find what marching through the whole finds") {
    Random rng(213);
    Compared all;
    for (int n = 0; n < (long_tests() ? 200 : 8); ++n)
        compare_crossings(Set{.phase = Phase{1},
                              .of = Displace{.of = Sphere{.radius = 0.6f},
                                             .amplitude = rng.uniform(0.05f, 0.3f),
                                             .scale = std::exp2(rng.uniform(-3, 1)),
                                             .octaves = static_cast<float>(1 + rng.below(2))}},
                          {}, long_tests() ? 2000 : 300, rng, all);
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings");
    CHECK(all.crossings > all.rays);
    CHECK(all.different == 0);
}
