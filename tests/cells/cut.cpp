// Boxes of cells are cut to where interfaces can be, by the fields that meet at an edge and by set algebra. Random
// points here, and the comparisons of rays in rays.cpp, test that cells contain every interface.
#include <doctest/doctest.h>

#include <glm/trigonometric.hpp>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "source_directory.hpp"
#include "support/random_tree.hpp"

namespace test_cut {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

bool is_in_a_cell(const InterfaceCells& cells, const glm::vec3& p) {
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells.bounds(i).contains(p)) return true;
    return false;
}

double surface(const Bounds& box) {
    const glm::dvec3 e(box.extent());
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// Places where the label changes, each between two random points of a box with different labels.
struct Changes {
    std::size_t all = 0, outside = 0;
};
Changes changes_of(const InterfaceCells& cells, const Bounds& box, PhaseSet opaque, std::size_t pairs, Random& rng) {
    Evaluator::Workspace w;
    Changes changes;
    const auto is_met = [&](Phase a, Phase b) { return a != b && !(opaque.contains(a) && opaque.contains(b)); };
    for (std::size_t i = 0; i < pairs; ++i) {
        glm::vec3 p = rng.in(box), q = rng.in(box);
        Phase at_p = cells.label(p, w), at_q = cells.label(q, w);
        if (!is_met(at_p, at_q)) continue;
        for (int k = 0; k < 60; ++k) {
            const glm::vec3 m = 0.5f * (p + q);
            if (m == p || m == q) break;
            const Phase at_m = cells.label(m, w);
            if (is_met(at_p, at_m)) {
                q = m;
                at_q = at_m;
            } else {
                p = m;
                at_p = at_m;
            }
            if (!is_met(at_p, at_q)) break;
        }
        if (!is_met(at_p, at_q)) continue;
        ++changes.all;
        changes.outside += !is_in_a_cell(cells, p) && !is_in_a_cell(cells, q);
    }
    return changes;
}

}  // namespace

TEST_CASE("there is a cell wherever the label changes") {
    Random rng(31);
    Changes all;
    for (int i = 0; i < (long_tests() ? 2000 : 50); ++i) {
        const Phased object =
            IntersectShape{.of = random_object(rng, 3), .shape = Box{.size = glm::vec3(3)}, .phases_cut = {}};
        if (bounds(object).empty()) continue;
        const std::uint64_t materials = phases(object).bits & ~std::uint64_t{1};
        const PhaseSet opaque{rng.chance(0.5) ? materials : rng.chance(0.5) ? materials & 0b1010 : 0};
        const InterfaceCells cells(object, {.opaque = opaque});
        const Changes c = changes_of(cells, cells.bounds(), opaque, 300, rng);
        CAPTURE(i);
        CHECK(c.outside == 0);
        all.all += c.all;
    }
    MESSAGE(all.all, " changes");
    CHECK(all.all > 1500);
}

TEST_CASE("every kind of field is cut correctly at thresholds other than zero") {
    std::size_t changes = 0, kinds = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(33, kind);
        if (!kind.is_field) continue;
        CAPTURE(kind.name);
        ++kinds;
        for (int i = 0; i < (long_tests() ? 200 : 8); ++i) {
            const Field f = kind.field(rng, 2);
            const float by = rng.uniform(0.05f, 0.3f);
            const Field moved = i % 4 == 0   ? Field(Offset{f, by})
                                : i % 4 == 1 ? Field(Offset{f, -by})
                                : i % 4 == 2 ? Field(Shell{f, by})
                                             : Field(Shell{Shell{f, by}, 0.5f * by});
            const Field others = i % 8 < 4 ? Field(Union{{moved, Offset{Box{.size = glm::vec3(0.5f)}, by}}})
                                           : Field(Intersection{{moved, Offset{Sphere{.radius = 0.4f}, by}}});
            const glm::vec3 middle = 0.5f * rng.direction();
            const Bounds box = Bounds{middle, middle}.inflated(0.6f);
            const Phased object = IntersectShape{.of = Set{.phase = Phase{1}, .of = others},
                                                 .shape = warped(Translate{middle}, Box{.size = glm::vec3(1.2f)}),
                                                 .phases_cut = {}};
            if (bounds(object).empty()) continue;
            CAPTURE(i);
            // Large boxes, whose cuts are many, and small ones, which may be within a corner.
            const InterfaceCells cells(object, {.max_depth = 1 + rng.below(5)});
            const Changes c = changes_of(cells, box, {}, 100, rng);
            CHECK(c.outside == 0);
            changes += c.all;
        }
    }
    MESSAGE(kinds, " kinds, ", changes, " changes");
    CHECK(changes > 10'000);
}

TEST_CASE("boxes in which bumps meet the skin end where the bumps end") {
    const Phased object = read_tree(Document::from_file(source_directory() + "/scenes/tentacle.json")).object;
    const InterfaceCells cells(object, {.opaque = {phases(object).bits & ~std::uint64_t{1}}});
    double sum = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) sum += surface(cells.bounds(i));
    MESSAGE(cells.size(), " cells of surface ", sum);
    CHECK(cells.size() > 10'000);
    CHECK(sum < 105);  // 95; 116 if boxes are cut by the whole distance's linear bound alone
}

TEST_CASE("each of a gem's many facets is visited a few times, and the cells lie close around the gem") {
    const glm::vec3 centre(0.9f, 0.8f, 0.7f);
    Intersection gem{{Sphere{.radius = 2}}};
    constexpr int facets = 24;
    for (int i = 0; i < facets; ++i) {
        const float z = 1 - (2 * static_cast<float>(i) + 1) / facets, turn = 2.4f * static_cast<float>(i);
        const glm::vec3 normal(glm::sqrt(1 - z * z) * glm::vec2(glm::cos(turn), glm::sin(turn)), z);
        gem.of.push_back(Plane{.normal = normal, .offset = glm::dot(normal, centre) + 0.1f});
    }
    const InterfaceCells cells(Set{.phase = Phase{1}, .of = gem}, {.max_depth = 1});
    double sum = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) sum += surface(cells.bounds(i));
    MESSAGE(cells.size(), " cells of surface ", sum);
    CHECK(sum < 0.4);  // 0.32; 0.51 if each facet is asked again for every other
    Random rng(32);
    const Changes c = changes_of(cells, Bounds{centre, centre}.inflated(0.15f), {}, 1000, rng);
    CHECK(c.all > 200);
    CHECK(c.outside == 0);
}

}  // namespace test_cut
