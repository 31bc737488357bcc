// Pruning through the corner of a profile and a height: cells give the labels of the whole object on either side of
// every threshold at which an offset or a shell needs the corner, and their distances stay lower bounds.
#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/layered.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/profiles/circle.hpp"
#include "phasetree/nodes/profiles/extrude.hpp"
#include "phasetree/nodes/profiles/rectangle.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/random_tree.hpp"

namespace test_extrusions {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// A few disks and rectangles in a plane, some of them turned.
Field random_profile(Random& rng, int count) {
    std::vector<Field> all;
    for (int i = 0; i < count; ++i) {
        Field f = Circle{.radius = rng.uniform(0.05f, 0.3f)};
        if (rng.chance(0.5)) {
            f = Rectangle{.width = rng.uniform(0.1f, 0.6f), .height = rng.uniform(0.1f, 0.6f)};
            f = warped(Rotate{.angle = rng.uniform(0, 90)}, f);
        }
        all.push_back(warped(Translate{{rng.uniform(-1, 1), rng.uniform(-1, 1), 0}}, f));
    }
    if (rng.chance(0.3)) return SmoothUnion{.of = std::move(all), .radius = 0.2f};
    return Union{.of = std::move(all)};
}

float interface_distance(const Phases<float>& phi) {
    float first = Bounds::infinity, second = Bounds::infinity;
    for_each_phase(phi.present, [&](int i) {
        second = std::min(second, std::max(first, phi[i]));
        first = std::min(first, phi[i]);
    });
    return second;
}

}  // namespace

TEST_CASE("cells of extrusions have the whole object's labels, whatever the threshold of the corner is") {
    Random rng(181);
    Evaluator::Workspace w;
    std::size_t points = 0, wrong = 0, far_from_cells = 0;
    for (int n = 0; n < 40; ++n) {
        Field f = Extrude{.of = random_profile(rng, 6), .height = rng.uniform(0.1f, 1)};
        if (n % 4 == 1) f = Offset{.of = f, .amount = 0.1f};
        if (n % 4 == 2) f = Offset{.of = f, .amount = -0.04f};
        if (n % 4 == 3) f = Shell{.of = f, .half_thickness = 0.03f};
        if (n % 3 == 0) f = warped(Rotate{.axis = {1, 1, 0}, .angle = 40}, f);
        const Phased object = Layered{.of = Set{.phase = Phase{1}, .of = f}, .phase = Phase{2}, .thickness = 0.05f};
        const InterfaceCells cells(object);
        std::vector<Bounds> boxes;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Bounds box = cells.bounds(i);
            boxes.push_back(box);
            for (int k = 0; k < 10; ++k) {
                const glm::vec3 p = rng.in(box);
                const Phases<float> phi = cells.whole().distances(p, w);
                if (interface_distance(phi) < cells.resolution()) continue;
                ++points;
                wrong += cells.label(i, p, w) != label(phi);
            }
        }
        // Where an interface is, by bisection between two labels, there is a cell.
        for (int k = 0; k < 60; ++k) {
            glm::vec3 p = rng.in(cells.bounds()), q = rng.in(cells.bounds());
            const Phase here = cells.label(p, w);
            if (cells.label(q, w) == here) continue;
            for (int i = 0; i < 40; ++i) {
                const glm::vec3 middle = (p + q) * 0.5f;
                (cells.label(middle, w) == here ? p : q) = middle;
            }
            far_from_cells += std::none_of(boxes.begin(), boxes.end(), [&](const Bounds& b) { return b.contains(p); });
        }
    }
    MESSAGE(points, " points");
    CHECK(points > 50'000);
    CHECK(wrong == 0);
    CHECK(far_from_cells == 0);
}

TEST_CASE("a cell of an extrusion keeps few of its profile's parts") {
    Random rng(182);
    const Field f = Extrude{.of = random_profile(rng, 100), .height = 0.5f};
    const InterfaceCells cells(Phased(Set{.phase = Phase{1}, .of = f}));
    CHECK(cells.statistics().median_instructions <= 6);
    CHECK(cells.whole().program().instructions.size() > 300);
}

}  // namespace test_extrusions
