// Cells against the whole program: the same labels at points, the same interfaces along rays, valid distances. The
// whole program is itself held to set algebra and analytic roots in tests/lib.

#include "phasetree/cells/cells.hpp"
#include "source_directory.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "phasetree/phasetree.hpp"
#include "phasetree/reading/tree.hpp"
#include "support/compared_crossings.hpp"
#include "support/compared_labels.hpp"
#include "support/random_tree.hpp"

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Phased hourglass() {
    return read_tree(Document::from_file(source_directory() + "/scenes/hourglass.json")).object;
}

Phased cut_to_size(Phased object) {
    return IntersectShape{.of = std::move(object), .shape = Box{.size = glm::vec3(3)}, .phases_cut = {}};
}

/// A bounded random object whose bounds are not empty.
Phased traceable_object(Random& rng, int depth) {
    for (;;) {
        Phased object = cut_to_size(random_object(rng, depth));
        const Bounds b = bounds(object);
        if (!b.empty() && b.finite()) return object;
    }
}

std::vector<std::size_t> cells_at(const InterfaceCells& cells, const glm::vec3& p) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells.bounds(i).contains(p)) found.push_back(i);
    return found;
}

}  // namespace

TEST_CASE("a cell's program gives the whole object's labels in the cell and on its faces") {
    Random rng(7);
    Disagreements d = compare_labels(InterfaceCells(hourglass()), 200);
    CHECK(d.points > 100'000);
    CHECK(d.wrong == 0);
    const std::size_t enough = long_tests() ? 10'000'000 : 0;
    std::size_t points = 0, wrong = 0;
    for (int i = 0; i < 60 || points < enough; ++i) {
        const Phased object = traceable_object(rng, 4);
        d = compare_labels(InterfaceCells(object, {.quality = any_quality(rng)}), 20);
        points += d.points;
        wrong += d.wrong;
    }
    MESSAGE("points in cells of random trees: ", points);
    CHECK(points > 20'000);
    CHECK(wrong == 0);
}

TEST_CASE("a cell's program gives the whole object's labels with each kind of node at the root") {
    Random rng(8);
    const int trees = long_tests() ? 200 : 4;
    for (const NodeKind& kind : node_kinds()) {
        CAPTURE(kind.name);
        std::size_t points = 0;
        for (int i = 0, attempt = 0; i < trees && attempt < 50 * trees; ++attempt) {
            CAPTURE(i);
            const Phased object = cut_to_size(kind.object(rng, 2 + i % 3));
            // Some draws are empty.
            if (bounds(object).empty()) continue;
            const InterfaceCells cells(object);
            if (cells.size() == 0) continue;
            ++i;
            const Disagreements d = compare_labels(cells, 8);
            REQUIRE(d.wrong == 0);
            points += d.points;
        }
        CHECK(points > 50);
    }
}

TEST_CASE("endless copies are pruned as single ones are, away from the faces where space is folded") {
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

TEST_CASE("two endless grids of one point do not vouch for each other's folds") {
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

TEST_CASE("no interface passes outside the cells") {
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
            CHECK(!cells_at(cells, c->p_in).empty());
            p = c->p_out;
            phase = c->to;
        }
    }
    CHECK(found > 3000);
}

TEST_CASE("the nearest crossing over all cells is the whole object's") {
    Random rng(13);
    std::vector<Phased> objects{hourglass()};
    for (int i = 0; i < (long_tests() ? 300 : 12); ++i) objects.push_back(traceable_object(rng, 3));
    Compared all;
    for (const Phased& object : objects) compare_crossings(object, {}, 300, rng, all, any_quality(rng));
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > all.rays);
    CHECK(all.different == 0);
}

TEST_CASE("the nearest crossing over all cells is the whole object's with each kind of node at the root") {
    Random rng(14);
    const int trees = long_tests() ? 100 : 1;
    Compared all;
    int attempt_of_all = 0;
    for (const NodeKind& kind : node_kinds()) {
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

TEST_CASE("with opaque phases rays in the others meet what they met, and where opaque ones meet there are no cells") {
    Random rng(14);
    std::vector<Phased> objects{hourglass()};
    for (int i = 0; i < (long_tests() ? 300 : 12); ++i) objects.push_back(traceable_object(rng, 3));
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

    // A ball in a ball: of the inner one nothing is left, and of all that is opaque nothing at all.
    const Phased ball = Over{.of = {Set{.phase = Phase{1}, .of = Sphere{.radius = 0.5f}},
                                    Set{.phase = Phase{2}, .of = Sphere{.radius = 1}}}};
    const InterfaceCells outer(ball, {.opaque = {0b110}});
    REQUIRE(outer.size() > 0);
    for (std::size_t i = 0; i < outer.size(); ++i) CHECK(outer.bounds(i).contains(glm::vec3(0)) == false);
    for (const glm::vec3& p : {glm::vec3(0.5f, 0, 0), glm::vec3(0, -0.5f, 0)}) CHECK(cells_at(outer, p).empty());
    CHECK(InterfaceCells(ball, {.opaque = {0b111}}).size() == 0);
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
