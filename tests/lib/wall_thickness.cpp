// How thin walls are and where, and boxes of trees that are much larger than the object.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>

#include "phasetree/measuring/prove.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/thin_shell.hpp"
#include "support/simple_shapes.hpp"

namespace test_wall_thickness {

using namespace phasetree;
using namespace phasetree::tests::simple;

TEST_CASE("the thickness of a shell and the diameter of the ball in it are bracketed") {
    const Phased flask = ThinShell{.of = ball({}, 1), .shell = glass, .inside = water, .half_thickness = 0.15f};
    ProveOptions options;
    options.resolution = 0.08;
    const std::vector<WallThickness> walls = wall_thicknesses(flask, options);
    REQUIRE(walls.size() == 2);
    CHECK(walls[0].phase == glass);
    CHECK(walls[0].low <= 0.3);
    CHECK(walls[0].high >= 0.3);
    CHECK(walls[0].high < 0.6);
    CHECK(walls[0].low > 0.15);
    REQUIRE(walls[0].place);
    CHECK(std::abs(glm::length(Point(*walls[0].place)) - 1) < 0.15);
    CHECK(walls[1].phase == water);
    CHECK(walls[1].low <= 1.7);
    CHECK(walls[1].low > 0.8);
    CHECK(walls[1].high >= 1.7);
}

TEST_CASE("the place of a thin wall is where a dent is") {
    const Field dented = Difference{.from = block({1, 1, 0.4}), .subtract = {ball({0.3, 0.2, 1.5}, 1.4)}};
    ProveOptions options;
    options.resolution = 0.08;
    const std::vector<WallThickness> walls = wall_thicknesses(set(glass, dented), options);
    REQUIRE(walls.size() == 1);
    // 0.5 remains of 0.8 below the middle of the dent.
    CHECK(walls[0].low <= 0.5);
    CHECK(walls[0].high >= 0.5);
    CHECK(walls[0].high < 1.1);
    REQUIRE(walls[0].place);
    CHECK(glm::length(Point(*walls[0].place) - Point(0.3, 0.2, 0)) < 1);
}

TEST_CASE("the steps that a loose box costs are counted") {
    // A slanted cut leaves a cap of height 0.05, in the box of the ball.
    const Phased small =
        IntersectShape{.of = set(glass, ball({}, 1)), .shape = Plane{.normal = {0.6f, 0, 0.8f}, .offset = -0.95f}};
    const auto steps = [](const Phased& object) {
        const std::vector<Statement> statements{HasTightBounds{1.5}};
        const Proof proof = prove(object, statements)[0];
        CHECK(proof.verdict == Verdict::refuted);
        const std::string before = "takes ";
        const std::size_t at = proof.reason.find(before), instead = proof.reason.find(" steps per ray instead of ");
        REQUIRE(at != std::string::npos);
        REQUIRE(instead != std::string::npos);
        return std::pair(std::stod(proof.reason.substr(at + before.size())),
                         std::stod(proof.reason.substr(instead + 26)));
    };
    const auto [loose, tight] = steps(small);
    CHECK(loose >= 1);           // each ray meets the stated box
    CHECK(tight < 0.6 * loose);  // most rays pass the cap's box
    CHECK(tight > 0);
}

TEST_CASE("boxes that are much longer than the object are refuted, and others are proved") {
    const auto verdict = [](const Phased& object, double at_most) {
        const std::vector<Statement> statements{HasTightBounds{at_most}};
        const Proof proof = prove(object, statements)[0];
        CHECK((proof.verdict == Verdict::refuted) == !proof.reason.empty());
        return proof.verdict;
    };
    CHECK(verdict(set(glass, ball({1, 2, 3}, 1)), 1.2) == Verdict::proved);
    // A slanted cut leaves a cap of height 0.2, in the box of the ball.
    const Phased cap =
        IntersectShape{.of = set(glass, ball({}, 1)), .shape = Plane{.normal = {0.6f, 0, 0.8f}, .offset = -0.8f}};
    CHECK(verdict(cap, 1.3) == Verdict::refuted);
    CHECK(verdict(cap, 20) == Verdict::proved);
    CHECK_THROWS_AS(verdict(cap, 0.9), ModelError);
}

}  // namespace test_wall_thickness
