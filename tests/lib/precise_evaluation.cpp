// Components in double precision: they agree with floats and with the definitions of all nodes, are as smooth as the
// allowances say, and safe distances are safe.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/evaluation/precise_evaluator.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/long_tests.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_precise_evaluation {

using namespace phasetree;
using namespace phasetree::tests;
using glm::dvec3;

namespace {

Phased of_phase_1(Field f) {
    return Set{.phase = Phase{1}, .of = std::move(f)};
}

}  // namespace

TEST_CASE("every kind of node has the components of floats, and the labels of set algebra") {
    std::size_t points = 0, kinds = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(421, kind);
        for (int n = 0; n < (long_tests() ? 40 : 2); ++n) {
            const Phased object = kind.object(rng, 3);
            const PreciseEvaluator precise(object);
            const Evaluator floats(record(object));
            const Bounds region = region_of_interest(bounds(object));
            Evaluator::Workspace w;
            ++kinds;
            for (int k = 0; k < 12; ++k) {
                const glm::vec3 p = rng.in(region);
                const Phases<float> expected = floats.distances(p, w);
                double most = 1;
                for_each_phase(expected.present,
                               [&](int i) { most = std::max(most, std::abs(static_cast<double>(expected[i]))); });
                // Where a search or a fold changes its mind, both may have another value by more than rounding.
                for_each_phase(expected.present, [&](int i) {
                    const double v = precise.component(dvec3(p), Phase{static_cast<std::uint8_t>(i)});
                    INFO(kind.name, ", phase ", i, ": ", v, " instead of ", expected[i]);
                    CHECK(std::abs(v - static_cast<double>(expected[i])) < 1e-4 * most);
                });
                ++points;
                if (values(object, dvec3(p)).interface_distance() > 1e-3)
                    CHECK_MESSAGE(int(precise.label(dvec3(p)).index) == int(tests::label(object, dvec3(p)).index),
                                  kind.name);
            }
        }
    }
    CHECK(points == 12 * kinds);
}

TEST_CASE("the interface of two phases has the gradient of forward mode, for every kind of node") {
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(422, kind);
        for (int n = 0; n < (long_tests() ? 40 : 2); ++n) {
            const Phased object = kind.object(rng, 3);
            const PreciseEvaluator precise(object);
            const Bounds region = region_of_interest(bounds(object));
            std::vector<Phase> phases;
            for_each_phase(phasetree::phases(object).bits,
                           [&](int i) { phases.push_back(Phase{static_cast<std::uint8_t>(i)}); });
            for (int k = 0; k < 8; ++k) {
                const dvec3 p(rng.in(region));
                const Phase inside = phases.back(), outside = phases.front();
                if (inside == outside) continue;
                INFO(kind.name, " at ", p.x, ", ", p.y, ", ", p.z);
                const InterfaceSample s = precise.interface_sample(p, inside, outside);
                CHECK(s.value == 0.5 * precise.component(p, inside) - 0.5 * precise.component(p, outside));
                const dvec3 forward = 0.5 * precise.gradient(p, inside) - 0.5 * precise.gradient(p, outside);
                CHECK(glm::distance(s.gradient, forward) <= 1e-9 * (1 + glm::length(forward)));
            }
        }
    }
}

TEST_CASE("an interface is evaluated in the space of the primitive that it comes from") {
    const Field box = warped(Translate{.by = {1, 2, 3}}, warped(Rotate{.axis = {0, 0, 1}, .angle = 90}, Field(Box{})));
    const PreciseEvaluator object(of_phase_1(Union{.of = {box, Sphere{.radius = 0.5f}}}));
    const InterfaceSample s = object.interface_sample({1.125, 2.5, 3.25}, Phase{1}, vacuum);
    // The box is turned from x to y, so its own x is the scene's y.
    CHECK(glm::distance(s.inner, dvec3(0.5, -0.125, 0.25)) < 1e-6);
    CHECK(glm::distance(s.inner_by_point * dvec3(0, 1, 0), dvec3(1, 0, 0)) < 1e-6);
    CHECK(s.weight == doctest::Approx(1));
    CHECK(std::abs(s.value) < 1e-6);
    // An absent phase has no interface.
    CHECK(std::isnan(object.interface_sample({0, 0, 0}, Phase{2}, vacuum).value));
}

TEST_CASE("distances are exact to doubles, and gradients of unit length") {
    const PreciseEvaluator ball(of_phase_1(Sphere{.radius = 1})), torus(of_phase_1(Torus{.major = 1, .minor = 0.25f}));
    CHECK(ball.component({0.1, 0.2, 0.3}, Phase{1}) == std::sqrt(0.01 + 0.04 + 0.09) - 1);
    CHECK(ball.component({0.1, 0.2, 0.3}, vacuum) == 1 - std::sqrt(0.01 + 0.04 + 0.09));
    CHECK(ball.component({0.1, 0.2, 0.3}, Phase{2}) == std::numeric_limits<double>::infinity());
    const dvec3 p{0.9, 0.4, 0.2}, g = torus.gradient(p, Phase{1});
    const double rho = std::sqrt(0.81 + 0.16);
    CHECK(torus.component(p, Phase{1}) ==
          doctest::Approx(std::sqrt((rho - 1) * (rho - 1) + 0.04) - 0.25).epsilon(1e-15));
    CHECK(glm::length(g) == doctest::Approx(1).epsilon(1e-14));
    // A twist has the sine and cosine of a double, not a polynomial for floats. The plane of a field far from the axis
    // would show an error of 10⁻⁸ there.
    const PreciseEvaluator twisted(of_phase_1(warped(Twist{.rate = 90}, Box{.size = {4, 1, 1}})));
    const double a = 0.3 * std::acos(-1.0) / 2, r = 0.5;
    const dvec3 on_face(-r * std::sin(a), r * std::cos(a), 0.3);
    CHECK(std::abs(twisted.component(on_face, Phase{1})) < 1e-7);
}

TEST_CASE("a phase does not change within a safe distance") {
    Random rng(422);
    std::size_t compared = 0, informative = 0;
    for (int n = 0; n < (long_tests() ? 1000 : 60); ++n) {
        const Phased object = random_object(rng, 3);
        const PreciseEvaluator evaluator(object);
        const Bounds region = region_of_interest(bounds(object));
        for (int k = 0; k < 20; ++k) {
            const dvec3 p(rng.in(region));
            const double safe = evaluator.safe_distance(p);
            REQUIRE(safe >= 0);
            if (!(safe < 1e6)) continue;
            CHECK(safe <= evaluator.sample(p).interface_distance + 1e-300);
            informative += safe > 0.01;
            for (int i = 0; i < 8; ++i) {
                const dvec3 q = p + dvec3(rng.direction()) * (safe * (1 - 1e-12) * std::cbrt(rng.unit()));
                CHECK(evaluator.label(q) == evaluator.label(p));
                ++compared;
            }
        }
    }
    CHECK(compared > 5000);
    CHECK(informative > 400);
}

TEST_CASE("batches of points, points that are not finite, and cancellation") {
    const PreciseEvaluator ball(of_phase_1(Sphere{.radius = 1}));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const std::vector<dvec3> points{{0, 0, 0}, {nan, 0, 0}, {0, infinity, 0}, {0, 0, 1e200}, {0, 0, 2}};
    std::vector<Phase> phases(points.size());
    std::vector<double> distances(points.size());
    CHECK(ball.locate(points, phases));
    CHECK(ball.safe_distances(points, distances));
    CHECK(phases[0] == Phase{1});
    for (std::size_t i = 1; i < phases.size(); ++i) CHECK(phases[i] == vacuum);
    CHECK(distances[0] == doctest::Approx(1).epsilon(2e-6));
    CHECK(distances[0] <= 1);
    for (std::size_t i = 1; i < 4; ++i) CHECK(std::isnan(distances[i]));
    CHECK(distances[4] == doctest::Approx(1).epsilon(2e-6));
    CHECK_FALSE(ball.locate(points, phases, [] { return true; }));
    CHECK_THROWS_AS(ball.locate(points, std::span(phases).first(2)), std::invalid_argument);
    // An unbounded object has phases, too.
    const PreciseEvaluator ground(of_phase_1(Plane{}));
    CHECK(ground.label({1e9, 0, -1e-9}) == Phase{1});
    CHECK(ground.label({1e9, 0, 1e-9}) == vacuum);
}

TEST_CASE("objects that search in floats say so") {
    const PreciseEvaluator ball(of_phase_1(Sphere{.radius = 1}));
    CHECK(ball.value_error(1) == 0x1p-44);
    Random rng(423);
    for (const NodeKind& kind : node_kinds()) {
        if (kind.name != "mesh" && kind.name != "balls" && kind.name != "volume") continue;
        Random own = random_for(423, kind);
        CHECK_MESSAGE(PreciseEvaluator(kind.object(own, 2)).value_error(1) == 0x1p-22, kind.name);
    }
}

}  // namespace test_precise_evaluation
