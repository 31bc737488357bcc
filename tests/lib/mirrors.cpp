// Folding by mirrors ends in one sector or chamber, from everywhere, and keeps lengths.
#include "phasetree/nodes/fields/mirrors.hpp"

#include <doctest/doctest.h>

#include "support/random_tree.hpp"

namespace test_mirrors {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a polygon's mirrors leave one sector") {
    Random rng(161);
    for (int sides = 3; sides <= 64; ++sides) {
        const auto mirrors = phasetree::detail::PolygonMirrors::of(static_cast<float>(sides));
        for (int n = 0; n < 2000; ++n) {
            float x = rng.uniform(-1, 1), y = rng.uniform(-1, 1);
            const float before = std::hypot(x, y);
            mirrors.fold(x, y);
            CAPTURE(sides);
            REQUIRE(std::hypot(x, y) == doctest::Approx(before).epsilon(1e-5));
            const double angle = std::atan2(static_cast<double>(y), static_cast<double>(x));
            REQUIRE(std::min(angle, 3.14159265358979 / sides - angle) * before > -2e-6);
        }
    }
}

TEST_CASE("the icosahedron's mirrors leave one of their 120 chambers") {
    // A chamber is a triangle with the angles π/2, π/3 and π/5: 1/120 of the sphere. A missed part of the chamber would
    // change the number of points within it.
    Random rng(162);
    int within = 0;
    const int points = 200'000;
    const auto outside = [](const glm::vec3& p) {
        const float golden = 1.6180340f;
        return std::max({-p.x, -p.y, -p.z, 0.5f * (golden * p.x - p.y / golden + p.z)});
    };
    for (int n = 0; n < points; ++n) {
        const glm::vec3 p = rng.direction();
        within += outside(p) <= 0;
        Vec3<float> q{p.x, p.y, p.z};
        phasetree::detail::IcosahedralMirrors::fold(q);
        REQUIRE(length(q) == doctest::Approx(1).epsilon(1e-5));
        REQUIRE(outside({q.x, q.y, q.z}) < 1e-6f);
    }
    // Of 1667 expected, five standard deviations.
    CHECK(std::abs(within - points / 120) < 205);
}

}  // namespace test_mirrors
