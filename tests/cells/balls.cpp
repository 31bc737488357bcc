// Rays through cells of lists of balls. The program of a cell has only the few balls that matter there; rays must find
// what marching through the whole object finds.
#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/instances.hpp"
#include "phasetree/nodes/fields/balls.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/layered.hpp"
#include "phasetree/nodes/phased/particles.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "support/compared_crossings.hpp"

namespace test_balls {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

FromFile<BallList> random_balls(Random& rng, int count, int phases) {
    BallList list;
    const float usual = 0.8f / std::cbrt(static_cast<float>(count));
    for (int i = 0; i < count; ++i) {
        list.centres.emplace_back(rng.uniform(-0.8f, 0.8f), rng.uniform(-0.8f, 0.8f), rng.uniform(-0.8f, 0.8f));
        list.radii.push_back(rng.uniform(0.4f, 1.2f) * usual);
        list.phases.push_back(static_cast<std::uint8_t>(rng.below(phases)));
    }
    return {"balls", std::make_shared<const BallList>(std::move(list))};
}

Phased object_of(Random& rng, int kind) {
    const Field balls = Balls{.file = random_balls(rng, 200, 1)};
    if (kind == 0) return Particles{.of_phases = {Phase{1}, Phase{2}, Phase{3}}, .file = random_balls(rng, 400, 3)};
    if (kind == 1)  // the distance itself matters here, and not its sign alone
        return Layered{.of = Set{.phase = Phase{1}, .of = balls}, .phase = Phase{2}, .thickness = 0.05f};
    if (kind == 2)
        return Set{.phase = Phase{1}, .of = SmoothUnion{.of = {balls, Box{.size = {2, 2, 0.2f}}}, .radius = 0.1f}};
    if (kind == 3) {  // one list at several places, whose lists in boxes must not be taken for each other's
        FieldInstances several;
        several.of = balls;
        several.positions = {{0, 0, 0}, {0.3f, 0.1f, 0}};
        several.turns = {0, 40};
        return Set{.phase = Phase{1}, .of = several};
    }
    return IntersectShape{.of = Particles{.of_phases = {Phase{1}, Phase{2}}, .file = random_balls(rng, 3000, 2)},
                          .shape = Box{.size = {1.2f, 1, 1}}};
}

}  // namespace

TEST_CASE("rays through cells of listed balls find what marching through the whole finds") {
    Random rng(395);
    Compared all;
    for (int n = 0; n < (long_tests() ? 200 : 10); ++n)
        compare_crossings(object_of(rng, n % 5), {}, long_tests() ? 1000 : 150, rng, all);
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings");
    CHECK(all.crossings > all.rays / 2);
    CHECK(all.different == 0);
}

TEST_CASE("labels in cells of opaque balls are those of the whole") {
    Random rng(396);
    const Phased object =
        Particles{.of_phases = {Phase{1}, Phase{2}, Phase{3}, Phase{4}}, .file = random_balls(rng, 5000, 4)};
    Compared all;
    compare_crossings(object, PhaseSet::of(std::vector{Phase{1}, Phase{2}, Phase{3}, Phase{4}}), 150, rng, all);
    CHECK(all.crossings > 50);
    CHECK(all.different == 0);
}

}  // namespace test_balls
