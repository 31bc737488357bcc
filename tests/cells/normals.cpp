// Tests the normals from cells as tests/lib/normals.cpp tests those from whole programs.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/normal_checks.hpp"

namespace test_normals {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Calls found(cell, crossing) for each cell that holds a crossing and finds it.
template <class CellBuffer>
void each_cell(const InterfaceCells& cells, const Crossing& c, const glm::vec3& d, CellBuffer&& found) {
    const float size = cells.bounds().diagonal();
    const glm::vec3 o = c.p_from - 0.01f * size * d;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (!cells.bounds(cell).contains(c.p_from) || !cells.bounds(cell).contains(c.p_to)) continue;
        TraceCounters unused;
        const auto again = cells.first_crossing(cell, o, d, 0, 0.02f * size, {}, Evaluator::thread_workspace(), unused);
        if (again && again->from == c.from && again->to == c.to &&
            glm::length(again->p_from - c.p_from) < 3 * cells.resolution())
            found(cell, *again);
    }
}

}  // namespace

TEST_CASE("no normal of a cell is an outlier, whatever the node") {
    const FlushSubnormals flush;
    NormalTotals all;
    const int trees = long_tests() ? 30 : 2, rays = long_tests() ? 60 : 12;
    for (const NodeKind& kind : node_kinds()) {
        Random rng(81);
        for (int tree = 0; tree < trees; ++tree) {
            const auto object = traceable(kind.object(rng, 1 + tree % 3 + !kind.is_field));
            if (!object) continue;
            const InterfaceTracer tracer(*object);
            const InterfaceCells cells(*object, {.max_depth = 5});
            grazing_rays(*object, tracer, rng, rays, 20, [&](const glm::vec3& o, const glm::vec3& ray) {
                each_crossing(tracer, o, ray, [&](const Crossing& c, const glm::vec3& d) {
                    each_cell(cells, c, d, [&](std::size_t cell, const Crossing& again) {
                        const CrossingNormal normal = cells.normal(cell, again, d);
                        const NormalCheck check{*object, again, d, cells.resolution(), normal.unit};
                        REQUIRE(glm::dot(normal.unit, d) > 0);
                        all.count(check, check.verdict(), kind.name);
                        // What is known of the growth there is along the normal.
                        const float slope = glm::length(normal.gradient);
                        REQUIRE(slope <= 1 + 1e-4f);
                        if (slope > 0) REQUIRE(glm::length(normal.gradient / slope - normal.unit) < 1e-5f);
                    });
                });
            });
        }
    }
    MESSAGE(all.right, " normals, ", all.by_an_edge, " more by edges");
    INFO(all.complaints);
    CHECK(all.wrong == 0);
    CHECK(all.right > 40'000);
    CHECK(all.right > 10 * all.by_an_edge);
}

TEST_CASE("a leaning cone's side, grazed, has one normal in its cells, too") {
    const FlushSubnormals flush;
    const Phased cone = leaning_cone();
    const InterfaceTracer tracer(cone);
    const InterfaceCells cells(cone);
    NormalTotals all;
    rays_at_leaning_cone(2000, [&](const glm::vec3& o, const glm::vec3& ray) {
        each_crossing(tracer, o, ray, [&](const Crossing& c, const glm::vec3& d) {
            each_cell(cells, c, d, [&](std::size_t cell, const Crossing& again) {
                const NormalCheck check{cone, again, d, cells.resolution(), cells.normal(cell, again, d).unit};
                all.count(check, check.verdict(), "cone");
            });
        });
    });
    INFO(all.complaints);
    CHECK(all.wrong == 0);
    CHECK(all.by_an_edge == 0);
    CHECK(all.right > 3500);
}

}  // namespace test_normals
