#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/blob.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "support/random_tree.hpp"

namespace test_blob {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Blob two_points(float apart) {
    Blob blob{.points = {{0, 0, 0}, {apart, 0, 0}}, .polyline = {}, .of = {}, .radii = {1}, .weights = {}};
    blob.prepare();
    return blob;
}

}  // namespace

TEST_CASE("the slope's bound is that of the steepest place, not the sum of all") {
    // Far apart, each is alone: 6x(1 − x²)² at x² = 1/5 is 1.7173.
    CHECK(two_points(5).slope == doctest::Approx(1.7173).epsilon(0.021));
    CHECK(two_points(5).slope >= 1.7172f);
    // In one place, they add.
    CHECK(two_points(0).slope == doctest::Approx(2 * 1.7173).epsilon(0.021));
    CHECK(two_points(0).slope >= 2 * 1.7172f);
    // In between, the sum of both at the worst point, found by a search along the axis and perpendicular to it.
    const float apart = 0.7f;
    double steepest = 0;
    for (int i = 0; i <= 400; ++i)
        for (int j = 0; j <= 200; ++j) {
            const double x = -1 + 0.01 * i * 0.675, y = 0.005 * j;
            const auto slope = [](double d) { return d < 1 ? 6 * d * (1 - d * d) * (1 - d * d) : 0.0; };
            steepest =
                std::max(steepest, slope(std::hypot(x, y)) + slope(std::hypot(x - static_cast<double>(apart), y)));
        }
    CHECK(two_points(apart).slope == doctest::Approx(steepest).epsilon(0.03));
    CHECK(static_cast<double>(two_points(apart).slope) >= steepest * 0.9999);
}

TEST_CASE("a blob of one point is a ball") {
    // (1 − x²)³ = ½ at x = √(1 − ∛½).
    const Field blob = Blob{.points = {{1, 2, 3}}, .polyline = {}, .of = {}, .radii = {2}, .weights = {}};
    const float radius = 2 * std::sqrt(1 - std::cbrt(0.5f));
    Random rng(71);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 p = glm::vec3(1, 2, 3) + rng.uniform(0, 3) * rng.direction();
        const float expected = glm::length(p - glm::vec3(1, 2, 3)) - radius, f = distance(blob, p);
        if (std::abs(expected) > 1e-5f) CHECK((f < 0) == (expected < 0));
        CHECK(std::abs(f) <= std::abs(expected) + 1e-5f);
        if (expected > 0) CHECK(f == doctest::Approx(expected).epsilon(1e-4));  // outside it is exact
    }
}

TEST_CASE("skeletons out of reach are not in a cell's program") {
    Blob many{.points = {}, .polyline = {}, .of = {}, .radii = {0.3f}, .weights = {}};
    for (int i = 0; i < 200; ++i) many.points.emplace_back(0.2f * static_cast<float>(i), 0, 0);
    const InterfaceCells cells(Phased(Set{.phase = Phase{1}, .of = many}));
    CHECK(cells.statistics().median_instructions < 60);
    CHECK(cells.whole().program().instructions.size() > 1000);
}

TEST_CASE("a blob's mistakes are told") {
    const auto error = [](Blob blob) -> std::string {
        try {
            (void)Field(std::move(blob));
        } catch (const ModelError& e) {
            return e.what();
        }
        return {};
    };
    CHECK(error(Blob{.points = {}, .polyline = {}, .of = {}, .radii = {1}, .weights = {}}) ==
          "blob: skeletons are required: \"points\", a \"polyline\" or fields in \"of\"");
    CHECK(
        error(Blob{.points = {{0, 0, 0}}, .polyline = {}, .of = {}, .radii = {1}, .weights = {}, .threshold = 1.5f}) ==
        "blob: the threshold exceeds the sum of all skeletons, so the solid is empty");
    CHECK(error(Blob{.points = {{0, 0, 0}}, .polyline = {}, .of = {}, .radii = {1, 2}, .weights = {}}) ==
          "blob: \"radii\" and \"weights\" need one entry per skeleton, or one for all");
}

}  // namespace test_blob
