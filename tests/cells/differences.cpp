// Near a joint of two solids that continue each other, such as the links of a bent arm, their distances and gradients
// are nearly the same, and only an enclosure of their difference proves which of them is nearer. Pruning by this
// enclosure must not move the surface, and must delete most of what can be deleted.

#include <doctest/doctest.h>

#include <numbers>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/round_cone.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/layered_sequence.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/compared_crossings.hpp"
#include "support/random_tree.hpp"

namespace test_differences {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Links along a helix, each as long as the next and thinner or thicker.
struct Arm {
    float bend = 3, rise = 0.3f, thick = 0.3f, taper = 0.5f;
    int links = 24;
    glm::dmat3 turn{1};

    glm::vec3 at(int i) const {
        const double u = static_cast<double>(i) / links, a = bend * u;
        return glm::vec3(turn * glm::dvec3(std::cos(a), std::sin(a), rise * u));
    }
    float radius(int i) const { return thick * (1 - taper * static_cast<float>(i) / static_cast<float>(links)); }

    template <class Join>
    Field joined(const Join& join) const {
        Field all = link(0);
        for (int i = 1; i < links; ++i) all = join(all, link(i));
        return all;
    }
    Field link(int i) const { return RoundCone{at(i), radius(i), at(i + 1), radius(i + 1)}; }
};

Arm random_arm(Random& rng) {
    const glm::dvec3 x(rng.direction()), y = glm::normalize(glm::cross(x, glm::dvec3(rng.direction())));
    return {.bend = rng.uniform(1, 6),
            .rise = rng.uniform(0, 1),
            .thick = std::exp2(-rng.uniform(1.5f, 4)),
            .taper = rng.uniform(-0.5f, 0.8f),
            .links = 4 + rng.below(28),
            .turn = glm::dmat3(x, y, glm::cross(x, y))};
}

void check_rays(const Phased& object, Random& rng, Compared& all) {
    const std::size_t before = all.different;
    compare_crossings(object, {}, 400, rng, all, any_quality(rng));
    CHECK(all.different == before);
}
void check_totals(const Compared& all) {
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > all.rays);
}

}  // namespace

TEST_CASE("links of an arm are pruned by their difference, and rays meet what they meet of the whole arm") {
    Random rng(37);
    Compared all;
    for (int n = 0; n < (long_tests() ? 3000 : 120); ++n) {
        const Arm arm = random_arm(rng);
        const float soft = arm.thick * std::exp2(-rng.uniform(2, 7));
        Field solid = arm.joined([&](const Field& a, const Field& b) -> Field {
            if (n % 4 == 1) return SmoothUnion{.of = {a, b}, .radius = soft};
            return Union{{a, b}};
        });
        if (n % 4 == 2) solid = Difference{.from = Box{.size = glm::vec3(3)}, .subtract = {solid}};
        Phased object = Set{.phase = Phase{1}, .of = solid};
        if (n % 4 == 3)
            object = LayeredSequence{.of = object,
                                     .layers = {Phase{2}, Phase{3}},
                                     .thicknesses = {0.2f * arm.thick, rng.uniform(0.01f, 0.2f) * arm.thick}};
        CAPTURE(n);
        check_rays(object, rng, all);
    }
    check_totals(all);
}

TEST_CASE("a shallow dome and its plate are pruned by the curvature of the dome") {
    Random rng(38);
    Compared all;
    for (int n = 0; n < (long_tests() ? 3000 : 200); ++n) {
        // Along an axis boxes lie as the plate does, and their corners are where the dome has bent the most.
        const glm::vec3 up = n % 4 == 0 ? rng.direction() : glm::vec3(n % 4 == 1, n % 4 == 2, n % 4 == 3);
        const float radius = std::exp2(rng.uniform(-1, 1)), rim = rng.uniform(0.05f, 0.4f);
        const float height = std::sqrt(radius * radius - rim * rim);
        const Field ball = warped(Translate{-height * up + 0.1f * rng.direction()}, Sphere{.radius = radius});
        const Field plate = Plane{.normal = up};
        Field both = Union{{ball, plate}};
        if (n % 8 >= 4) both = Intersection{{ball, plate}};
        if (n % 16 >= 12) both = SmoothUnion{.of = {ball, plate}, .radius = std::exp2(-rng.uniform(4, 10))};
        const Field block = Box{.size = glm::vec3(1)};
        const Phased object = Set{.phase = Phase{1},
                                  .of = n % 32 < 16 ? Field(Intersection{{both, block}})
                                                    : Field(Difference{.from = block, .subtract = {both}})};
        CAPTURE(n);
        check_rays(object, rng, all);
    }
    check_totals(all);
}

TEST_CASE("cells of an arm of many short links have three links") {
    const Arm arm{.links = 48};
    const Field solid = arm.joined([](const Field& a, const Field& b) { return Union{{a, b}}; });
    const CellStatistics cells = InterfaceCells(Set{.phase = Phase{1}, .of = solid}).statistics();
    MESSAGE(cells.cells, " cells, median of ", cells.median_instructions, " instructions, 90 % up to ",
            cells.percentile90_instructions);
    // By their own ranges four, half of them five.
    CHECK(cells.median_instructions == 5);
    CHECK(cells.percentile90_instructions <= 7);
}

}  // namespace test_differences
