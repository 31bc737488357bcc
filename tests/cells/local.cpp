// Cells of Voronoi patterns, whose programs have the few sites that matter there: rays must find what marching through
// the whole object finds, which looks at all sites.
#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/fields/voronoi_cells.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/voronoi.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/compared_crossings.hpp"

namespace test_local {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Field blocks(Random& rng) {
    const float size = rng.uniform(0.2f, 0.5f);
    return VoronoiCells{.size = size,
                        .gap = 0.1f * size,
                        .rounding = rng.chance(0.5) ? 0.f : 0.1f * size,
                        .jitter = rng.uniform(0.3f, 1),
                        .seed = static_cast<float>(rng.below(289))};
}

/// One pattern at several places, whose specialisations must not be taken for each other's. Only enclosures prove that
/// a twisted bar among them is away, so the patterns are enclosed a second time without it.
Phased several(Random& rng) {
    const Field pattern = blocks(rng);
    const Field moved = warped(Translate{.by = 0.3f * rng.direction()}, pattern);
    const Field turned = warped(Rotate{.axis = rng.direction(), .angle = rng.uniform(10, 80)}, pattern);
    const Field bar = warped(Twist{.rate = 400}, Box{.size = {0.5f, 0.3f, 1.2f}});
    return Set{
        .phase = Phase{1},
        .of = Intersection{.of = {Sphere{.radius = 0.8f},
                                  Union{.of = {bar, Intersection{.of = {Union{.of = {pattern, moved}}, turned}}}}}}};
}

Phased colours(Random& rng) {
    const float size = rng.uniform(0.2f, 0.5f), jitter = rng.uniform(0, 1);
    const auto seed = static_cast<float>(rng.below(289));
    const Phased cells =
        Voronoi{.of_phases = {Phase{1}, Phase{2}, Phase{3}, Phase{1}}, .size = size, .jitter = jitter, .seed = seed};
    const Field gaps =
        VoronoiCells{.size = size, .gap = 0.1f * size, .rounding = 0.05f * size, .jitter = jitter, .seed = seed};
    return IntersectShape{.of = IntersectShape{.of = cells, .shape = Box{.size = glm::vec3(1.3f)}}, .shape = gaps};
}

}  // namespace

TEST_CASE("rays through cells of Voronoi patterns find what marching through the whole finds") {
    Random rng(218);
    Compared all;
    std::size_t cells = 0, routines = 0;
    for (int n = 0; n < (long_tests() ? 300 : 6); ++n) {
        const Phased object =
            n % 3 == 0   ? several(rng)
            : n % 3 == 1 ? colours(rng)
                         : Set{.phase = Phase{1}, .of = Intersection{.of = {Sphere{.radius = 0.8f}, blocks(rng)}}};
        compare_crossings(object, {}, long_tests() ? 2000 : 200, rng, all);
        const CellStatistics s = InterfaceCells(object).statistics();
        CHECK(s.cells > 1000);  // as large as they come where a price takes no notice of the pattern's size: eight
        cells += s.cells;
        routines += s.routines;
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings; ", cells, " cells, ", routines, " programs");
    CHECK(all.crossings > all.rays);
    CHECK(all.different == 0);
    // With all sites one program does for most.
    CHECK(routines > cells / 20);
}

}  // namespace test_local
