#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/scatter.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace test_scatter {

using namespace phasetree;

namespace {

/// By how many standard deviations the mean of heights differs from that of a uniform sphere, where heights are uniform
/// in [−1, 1] (Archimedes) with variance 1/3.
double deviation(const std::vector<double>& heights) {
    double sum = 0;
    for (const double z : heights) sum += z;
    return std::abs(sum) / std::sqrt(static_cast<double>(heights.size()) / 3);
}
/// The same for the squares, of mean 1/3 and variance 4/45.
double deviation_of_squares(const std::vector<double>& heights) {
    double sum = 0;
    for (const double z : heights) sum += z * z - 1.0 / 3;
    return std::abs(sum) / std::sqrt(static_cast<double>(heights.size()) * 4 / 45);
}

}  // namespace

TEST_CASE("scattered points are on the surface, their normals are the surface's, and they are uniform by area") {
    const auto points = detail::scattered(Sphere{.radius = 2}, 100'000, 0, 7);
    REQUIRE(points.size() == 100'000);
    std::vector<double> heights;
    for (const detail::SurfacePoint& at : points) {
        REQUIRE(std::abs(glm::length(at.position) - 2) < 1e-5f);
        REQUIRE(glm::dot(at.normal, glm::dvec3(at.position)) > 2 * 0.999);
        heights.push_back(static_cast<double>(at.position.z) / 2);
    }
    // A line's two crossings are independent: uniform chords and chords between uniform points have one distribution.
    CHECK(deviation(heights) < 4);
    CHECK(deviation_of_squares(heights) < 4);
    // One in a hundred moved to the pole is seen by both.
    for (std::size_t i = 0; i < heights.size(); i += 100) heights[i] = 1;
    CHECK(deviation(heights) > 4);
    CHECK(deviation_of_squares(heights) > 4);
}

TEST_CASE("scattered points keep their distance, and depend on the seed alone") {
    const Field surface = Difference{.from = Box{.size = glm::vec3(2)}, .subtract = {Sphere{.radius = 1.2f}}};
    const auto points = detail::scattered(surface, 400, 0.15f, 3);
    CHECK(points.size() > 200);
    for (std::size_t i = 0; i < points.size(); ++i) {
        REQUIRE(std::abs(distance(surface, points[i].position)) < 1e-4f);
        for (std::size_t j = 0; j < i; ++j) REQUIRE(glm::length(points[i].position - points[j].position) >= 0.15f);
    }
    const auto again = detail::scattered(surface, 400, 0.15f, 3), other = detail::scattered(surface, 400, 0.15f, 4);
    REQUIRE(again.size() == points.size());
    CHECK(again.back().position == points.back().position);
    CHECK(other.front().position != points.front().position);
}

TEST_CASE("a surface without end or without points is rejected") {
    CHECK_THROWS_WITH_AS((void)detail::scattered(Plane{}, 10, 0, 1),
                         doctest::Contains("scatter: the surface is unbounded"), ModelError);
    const Field nothing =
        Intersection{.of = {Sphere{.radius = 0.1f},
                            WarpedField<Translate>{{Translate{{0.15f, 0.15f, 0}}, Sphere{.radius = 0.1f}, {}}}}};
    CHECK_THROWS_AS((void)detail::scattered(nothing, 10, 0, 1), ModelError);
}

}  // namespace test_scatter
