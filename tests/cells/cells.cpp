// Cells are compared with the whole program: they must give the same labels and valid distances at points. The whole
// program itself is compared with set algebra and analytic roots in tests/lib.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "cells/traceable.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/endless_grid.hpp"
#include "phasetree/nodes/copies/grid.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/compared_crossings.hpp"
#include "support/compared_labels.hpp"

namespace test_cells {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a cell's program gives the whole object's labels in the cell and on its faces") {
    Random rng(7);
    Disagreements d = compare_labels(InterfaceCells(hourglass()), 200);
    CHECK(d.points > 100'000);
    CHECK(d.wrong == 0);
    const std::size_t enough = long_tests() ? 10'000'000 : 0;
    std::size_t points = 0, wrong = 0;
    for (int i = 0; i < (long_tests() ? 60 : 24) || points < enough; ++i) {
        const Phased object = traceable_object(rng, 4);
        d = compare_labels(InterfaceCells(object, {.quality = any_quality(rng)}), 20);
        points += d.points;
        wrong += d.wrong;
    }
    MESSAGE("points in cells of random trees: ", points);
    CHECK(points > 20'000);
    CHECK(wrong == 0);
}

TEST_CASE("away from the faces where space is folded, endless copies are pruned like single objects") {
    // Eleven instructions tell a phase of a copy; the fold of space, the guard above it and the cut are a few more.
    const Phased ball = Under{.of = {Set{.phase = Phase{1}, .of = Sphere{.radius = 0.2f}},
                                     Set{.phase = Phase{2}, .of = Box{.size = glm::vec3(0.15f, 0.15f, 0.5f)}},
                                     Set{.phase = Phase{3}, .of = Torus{.major = 0.25f, .minor = 0.05f}}}};
    const Phased endless = cut_to_size(PhasedEndlessGrid{{.of = ball, .spacing = glm::vec3(0.7f)}});
    const Phased listed =
        cut_to_size(warped(Translate{glm::vec3(-2.1f)}, PhasedGrid{{{.of = ball}, glm::vec3(0.7f), 7, 7, 7}}));
    const CellStatistics a = InterfaceCells(endless).statistics(), b = InterfaceCells(listed).statistics();
    MESSAGE("endless: ", a.cells, " cells of ", a.median_instructions, " instructions, ", a.routines,
            " routines; listed: ", b.cells, " of ", b.median_instructions, ", ", b.routines);
    // One ball is one instruction, with where it is; the fold comes on top, and what guards its jumps.
    CHECK(a.median_instructions <= b.median_instructions + 3);
    CHECK(a.cells < 3 * b.cells);
    CHECK(a.routines < b.routines / 10);
    const Disagreements d = compare_labels(InterfaceCells(endless), 20);
    CHECK(d.points > 10'000);
    CHECK(d.wrong == 0);
}

TEST_CASE("of two endless grids that fold the same point, one that does not jump says nothing of the other") {
    const Phased object = read_tree(Document::from_text(R"({
        "version": 1,
        "phases": {"a": {"diffuse": {"color": [1, 1, 1]}}, "b": {"diffuse": {"color": [1, 1, 1]}}},
        "tree": {"intersect_shape": {"shape": {"box": {"size": [3, 3, 3]}}, "of": {"scatter": {
            "on": {"tetrahedron": {"radius": 1}}, "count": 2, "spacing": 1.017562, "smallest": 1, "seed": 1,
            "of": {"intersect_shape": {"shape": {"sphere": {"radius": 1.0702261}}, "of": {"under": {"of": [
                {"endless_grid": {"spacing": [0, 3.3410234, 1.5882553], "of": {"intersect_shape": {
                    "shape": {"sphere": {"radius": 1.4627479}},
                    "of": {"set": {"phase": "b", "of": {"plane": {"normal": [0, 0, 1], "offset": -0.29539108}}}}}}}},
                {"endless_grid": {"spacing": [1.3123698, 1.7285374, 3.243533], "of": {"intersect_shape": {
                    "shape": {"sphere": {"radius": 0.9170874}},
                    "of": {"set": {"phase": "a", "of": {"star":
                        {"points": 3, "radius": 0.7647479, "inner_radius": 0.04206609}}}}}}}}
            ]}}}}}}}}
    })"))
                              .object;
    const Disagreements d = compare_labels(InterfaceCells(object), 30);
    CHECK(d.points > 100'000);
    CHECK(d.wrong == 0);
}

TEST_CASE("every interface is inside a cell") {
    Random rng(11);
    const Phased object = hourglass();
    const InterfaceCells cells(object);
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    // Points found on interfaces by tracing the whole program must lie in a cell.
    std::size_t found = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 from = rng.in(cells.bounds().inflated(1)), to = rng.in(cells.bounds());
        const glm::vec3 d = glm::normalize(to - from);
        glm::vec3 p = from;
        Phase phase = tracer.label(p, w);
        while (const auto c = tracer.first_crossing(p, d, 0, 1e6f, phase, w)) {
            ++found;
            CHECK(!cells_at(cells, c->p_from).empty());
            p = c->p_to;
            phase = c->to;
        }
    }
    CHECK(found > 3000);
}

TEST_CASE("cells of a copy are the same, and few") {
    const InterfaceCells a(hourglass()), b(hourglass());
    REQUIRE(a.size() == b.size());
    bool equal = true;
    for (std::size_t i = 0; i < a.size(); ++i)
        equal = equal && a.bounds(i).low == b.bounds(i).low && a.bounds(i).high == b.bounds(i).high;
    CHECK(equal);
    CHECK(a.statistics().routines < a.size());
    CHECK(a.statistics().median_instructions < a.whole().program().instructions.size() / 5);
}

}  // namespace test_cells
