// The coil's one solution of Kepler's equation and two ends give the distance that a search along the whole line finds,
// for tight and steep coils, few turns and many, near and far.
#include <doctest/doctest.h>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/helix.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_helix {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("the coil's distance is that of a search along its line") {
    Random rng(171);
    double worst = 0;
    for (int coil = 0; coil < 400; ++coil) {
        const float turns = rng.chance(0.3) ? std::floor(rng.uniform(1, 8)) : rng.uniform(1, 8);
        const float pitch = std::exp2(rng.uniform(-4, 4)) * (rng.chance(0.3) ? -1.f : 1.f);
        const Field f = Helix{.radius = 1, .pitch = pitch, .turns = turns, .wire = 0.1f};
        const Bounds b = bounds(f);
        for (int n = 0; n < 60; ++n) {
            glm::vec3 p = rng.in(b.inflated(n % 3 == 0 ? 3.f : 0.2f));
            // Beyond the ends, and about the axis, where turns are equally near.
            if (n % 5 == 0) p.z = (rng.chance(0.5) ? b.high.z : b.low.z) + rng.uniform(-1, 1) * std::abs(pitch);
            if (n % 7 == 0) p *= glm::vec3(0.05f, 0.05f, 1);
            const double expected = value(f, glm::dvec3(p)), got = distance(f, p);
            const double error = std::abs(got - expected) / (1 + glm::length(p) + std::abs(pitch));
            worst = std::max(worst, error);
            CAPTURE(turns);
            CAPTURE(pitch);
            CAPTURE(p.x);
            CAPTURE(p.y);
            CAPTURE(p.z);
            REQUIRE(error < 2e-6);
        }
    }
    MESSAGE("largest error over 1 + |p| + pitch: ", worst);
}

TEST_CASE("the coil starts on the x axis and rises to the right as seen from outside, or to the left") {
    for (const float pitch : {0.5f, -0.5f}) {
        const Field f = Helix{.radius = 1, .pitch = pitch, .turns = 2, .wire = 0.1f};
        const float side = pitch < 0 ? -1.f : 1.f;
        CHECK(distance(f, {1, 0, -0.5f}) == doctest::Approx(-0.1f));
        CHECK(distance(f, {0, side, -0.375f}) == doctest::Approx(-0.1f));
        CHECK(distance(f, {-1, 0, -0.25f}) == doctest::Approx(-0.1f));
        CHECK(distance(f, {1, 0, 0.5f}) == doctest::Approx(-0.1f));
        CHECK(distance(f, {1, 0, 0.7f}) == doctest::Approx(0.1f));
    }
}

}  // namespace test_helix
