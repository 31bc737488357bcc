// Rays through cells must find the same interfaces as rays through the whole program.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "cells/traceable.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "support/compared_crossings.hpp"

namespace test_rays {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("the nearest crossing over all cells is the whole object's") {
    Random rng(13);
    std::vector<Phased> objects{hourglass()};
    for (int i = 0; i < (long_tests() ? 300 : 6); ++i) objects.push_back(traceable_object(rng, 3));
    Compared all;
    for (const Phased& object : objects) compare_crossings(object, {}, 300, rng, all, any_quality(rng));
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > all.rays);
    CHECK(all.different == 0);
}

TEST_CASE("with opaque phases rays in the others meet what they met, and where opaque ones meet there are no cells") {
    Random rng(14);
    std::vector<Phased> objects{hourglass()};
    for (int i = 0; i < (long_tests() ? 300 : 6); ++i) objects.push_back(traceable_object(rng, 3));
    Compared all;
    std::size_t cells_without = 0, cells_with = 0;
    for (const Phased& object : objects) {
        PhaseSet opaque;
        for_each_phase(phases(object).bits & ~std::uint64_t{1}, [&](int i) {
            if (rng.chance(0.7)) opaque = opaque | PhaseSet::of(Phase{static_cast<std::uint8_t>(i)});
        });
        compare_crossings(object, opaque, 300, rng, all, any_quality(rng));
        cells_without += InterfaceCells(object).size();
        cells_with += InterfaceCells(object, {.opaque = opaque}).size();
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.into_opaque, " into opaque phases, ", all.different,
            " different; ", cells_with, " cells for ", cells_without);
    CHECK(all.into_opaque > all.rays / 4);
    CHECK(all.different == 0);

    // A ball in a ball. Nothing is left of the inner one; if everything is opaque, no cell is left.
    const Phased ball = Over{.of = {Set{.phase = Phase{1}, .of = Sphere{.radius = 0.5f}},
                                    Set{.phase = Phase{2}, .of = Sphere{.radius = 1}}}};
    const InterfaceCells outer(ball, {.opaque = {0b110}});
    REQUIRE(outer.size() > 0);
    for (std::size_t i = 0; i < outer.size(); ++i) CHECK(outer.bounds(i).contains(glm::vec3(0)) == false);
    for (const glm::vec3& p : {glm::vec3(0.5f, 0, 0), glm::vec3(0, -0.5f, 0)}) CHECK(cells_at(outer, p).empty());
    CHECK(InterfaceCells(ball, {.opaque = {0b111}}).size() == 0);
}

TEST_CASE("the nearest crossing over all cells is the whole object's with each kind of node at the root") {
    const int trees = long_tests() ? 100 : 1;
    Compared all;
    int attempt_of_all = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(14, kind);
        CAPTURE(kind.name);
        for (int i = 0, attempt = 0; i < trees && attempt < 50 * trees; ++attempt) {
            const Phased object = cut_to_size(kind.object(rng, 1 + attempt_of_all++ % 3));
            if (bounds(object).empty()) continue;
            ++i;
            const std::size_t before = all.different;
            compare_crossings(object, {}, long_tests() ? 400 : 150, rng, all);
            CHECK(all.different == before);
        }
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > all.rays / 2);
}

}  // namespace test_rays
