// Solids displaced by noise, whose slope and curvature cells know: rays must find what marching through the whole
// object finds.
#include <doctest/doctest.h>

#include <atomic>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/displace.hpp"
#include "phasetree/nodes/fields/round_cone.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "support/compared_crossings.hpp"

namespace test_displaced {

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

TEST_CASE("the programs of a displaced solid's cells have no far bounds") {
    const InterfaceCells cells(Set{
        .phase = Phase{1},
        .of =
            Displace{.of = RoundCone{.from = {0, 0, -0.5f}, .radius_from = 0.6f, .to = {0, 0, 0.5f}, .radius_to = 0.3f},
                     .amplitude = 0.05f,
                     .scale = 0.2f}});
    // The solid, the noise, its amplitude, the sum and its slope; with the bounds there are four more.
    MESSAGE(cells.size(), " cells of ", cells.statistics().median_instructions, " to ",
            cells.statistics().max_instructions, " instructions");
    CHECK(cells.statistics().median_instructions <= 5);
}

// Noise that is this flat and fine saves rays nothing in boxes as small as its features, of which the box's faces have
// 200 million. A build would take hours to find that for each of them. It asks once for each division whether it is
// cancelled.
TEST_CASE("noise much finer than the object is not divided into its features where that saves nothing") {
    std::atomic<int> divisions{0};
    const InterfaceCells cells(
        Set{.phase = Phase{1},
            .of = Displace{.of = Box{.size = {4, 4, 1}}, .amplitude = 0.0003f, .scale = 0.002f, .octaves = 3}},
        {.cancelled = [&] { return ++divisions > 20'000; }});
    MESSAGE(divisions.load(), " divisions");
    CHECK(cells.size() < 1000);
}

}  // namespace test_displaced
