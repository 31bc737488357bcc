// Required intervals are passed down through long chains of operators. After pruning, a chain must be the same solid,
// without most of what can be deleted.

#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/blob.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/displace.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/smooth_difference.hpp"
#include "phasetree/nodes/fields/smooth_intersection.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/layered_sequence.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/subtract_shape.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/compared_crossings.hpp"
#include "support/compared_labels.hpp"
#include "support/random_tree.hpp"

namespace test_pruning {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Field random_solid(Random& rng, const glm::vec3& at, float size) {
    switch (rng.below(4)) {
        case 0:
            return warped(Translate{at}, Box{.size = size * glm::vec3(1, 2, 1.5f)});
        case 1:
            return warped(Translate{at}, Cylinder{.radius = 0.7f * size, .height = 2 * size});
        case 2:
            return Capsule{.from = at - 0.5f * size * rng.direction(), .to = at, .radius = 0.5f * size};
        default:
            return warped(Translate{at}, Sphere{.radius = size});
    }
}

/// Joined to what is there, so that much of it stays.
Field joined(const Field& all, const Field& solid, float size, Random& rng) {
    const float soft = size * std::exp2(-rng.uniform(1, 6)), thick = size * rng.uniform(0.1f, 0.5f);
    const Field block = Box{.size = glm::vec3(2.5f)};
    switch (rng.below(16)) {
        case 0:
            return SmoothUnion{.of = {all, solid}, .radius = soft};
        case 1:
            return SmoothDifference{.from = all, .subtract = {solid}, .radius = soft};
        case 2:
            return Difference{.from = all, .subtract = {solid}};
        case 3:  // its complement in a block, and that one's
            return Difference{.from = block, .subtract = {Difference{.from = block, .subtract = {all, solid}}}};
        case 4:
            return Offset{.of = Union{{all, solid}}, .amount = rng.chance(0.5) ? 0.2f * thick : -0.1f * thick};
        case 5:
            return Union{{Shell{.of = all, .half_thickness = 0.5f * thick}, solid}};
        case 6:
            return Intersection{{Union{{all, solid}}, Offset{.of = all, .amount = thick}}};
        case 7:
            return SmoothIntersection{.of = {Union{{all, solid}}, block}, .radius = soft};
        default:
            return rng.chance(0.5) ? Union{{all, solid}} : Union{{solid, all}};
    }
}

/// Solids along a walk.
Field random_chain(Random& rng) {
    const int links = 4 + rng.below(20), displaced = rng.below(2 * links);
    const float size = std::exp2(-rng.uniform(2, 4));
    glm::vec3 at = rng.in({glm::vec3(-0.5f), glm::vec3(0.5f)});
    Field all = random_solid(rng, at, size);
    std::vector<glm::vec3> walk{at};
    for (int i = 1; i < links; ++i) {
        const float step = rng.uniform(0.2f, 1.5f) * size;
        at = glm::clamp(at + step * rng.direction(), glm::vec3(-1), glm::vec3(1));
        walk.push_back(at);
        all = joined(all, random_solid(rng, at, size), size, rng);
        if (i != displaced) continue;
        // Of which an operand must be itself, up to a reach or around the surface.
        if (rng.chance(0.5))
            all = Displace{.of = all, .amplitude = 0.1f * size, .scale = 2 * size};
        else
            all = Blob{.polyline = walk, .of = {all}, .radii = {rng.uniform(1.5f, 3) * size}};
    }
    return all;
}

Phased random_chains(Random& rng) {
    const float thick = std::exp2(-rng.uniform(3, 8));
    const Phased one = Set{.phase = Phase{1}, .of = random_chain(rng)};
    switch (rng.below(4)) {
        case 0:
            return one;
        case 1:
            return LayeredSequence{.of = one, .layers = {Phase{2}, Phase{3}}, .thicknesses = {thick, 0.5f * thick}};
        case 2:
            return Under{{Set{.phase = Phase{2}, .of = random_chain(rng)}, one}};
        default:
            return SubtractShape{Over{{Set{.phase = Phase{2}, .of = random_chain(rng)}, one}},
                                 Plane{.normal = rng.direction(), .offset = 0.1f}, PhaseSet::of(Phase{1})};
    }
}

}  // namespace

TEST_CASE("what is left of long chains of all operators has the same labels, and rays meet the same") {
    Compared rays;
    std::size_t points = 0;
    for (int n = 0; n < (long_tests() ? 3000 : 40); ++n) {
        CAPTURE(n);
        Random rng(39'000 + static_cast<unsigned>(n));
        const Phased object = random_chains(rng);
        const BuildQuality quality = any_quality(rng);
        const Disagreements labels = compare_labels(InterfaceCells(object, {.quality = quality}), 8);
        CHECK(labels.wrong == 0);
        points += labels.points;
        const std::size_t before = rays.different;
        compare_crossings(object, {}, 200, rng, rays, quality);
        CHECK(rays.different == before);
    }
    MESSAGE(points, " points; ", rays.rays, " rays, ", rays.crossings, " crossings, ", rays.different, " different");
    CHECK(points > (long_tests() ? 10'000'000u : 500'000u));
    CHECK(rays.crossings > rays.rays);
}

TEST_CASE("far links of a chain are pruned, though each is too near to the next to be told from it by value") {
    // Boxes are small beside the chain and large beside a link's length.
    constexpr int links = 192;
    constexpr float length = 6.f / links;
    Field chain = Sphere{.radius = 0.3f};
    for (int i = 1; i < links; ++i)
        chain = Union{{chain, warped(Translate{{length * static_cast<float>(i), 0, 0}}, Sphere{.radius = 0.3f})}};
    const Phased object = LayeredSequence{
        .of = Set{.phase = Phase{1}, .of = chain}, .layers = {Phase{2}, Phase{3}}, .thicknesses = {0.05f, 0.03f}};
    const CellStatistics cells = InterfaceCells(object, {.quality = BuildQuality::low}).statistics();
    MESSAGE(cells.cells, " cells, up to ", cells.max_instructions, " instructions");
    // Told from its neighbours alone no link goes where neighbours are nearer than boxes are large: 387 of them, and
    // 52,000 cells.
    CHECK(cells.max_instructions <= 30);
    CHECK(cells.cells < 20'000);
}

}  // namespace test_pruning
