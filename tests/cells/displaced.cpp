// Solids displaced by noise, whose cells know its slope and how it bends: rays must find what marching the whole finds.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "phasetree/cells/cells.hpp"
#include "phasetree/phasetree.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("rays through cells of displaced solids find what marching through the whole finds") {
    Random rng(213);
    std::size_t rays = 0, hits = 0, different = 0;
    for (int n = 0; n < (long_tests() ? 100 : 8); ++n) {
        const Phased object = Set{.phase = Phase{1},
                                  .of = Displace{.of = Sphere{.radius = 0.6f},
                                                 .amplitude = rng.uniform(0.05f, 0.3f),
                                                 .scale = std::exp2(rng.uniform(-3, 1)),
                                                 .octaves = static_cast<float>(1 + rng.below(2))}};
        const InterfaceCells cells(object);
        const InterfaceTracer tracer(object);
        Evaluator::Workspace w;
        TraceCounters counters;
        for (int k = 0; k < (long_tests() ? 5000 : 500); ++k) {
            const glm::vec3 origin = 1.5f * rng.direction();
            const glm::vec3 direction = glm::normalize(0.7f * rng.direction() - origin);
            const auto expected = tracer.first_crossing(origin, direction, 0, 10, vacuum, w);
            std::vector<std::pair<float, std::size_t>> met;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                const Bounds box = cells.bounds(c);
                const glm::vec3 a = (box.low - origin) / direction, b = (box.high - origin) / direction;
                const glm::vec3 near = glm::min(a, b), far = glm::max(a, b);
                const float enter = std::max({near.x, near.y, near.z});
                if (enter <= std::min({far.x, far.y, far.z})) met.emplace_back(enter, c);
            }
            std::sort(met.begin(), met.end());
            std::optional<Crossing> first;
            for (const auto& [enter, c] : met) {
                if (first && first->t_in < enter) break;
                const auto found = cells.first_crossing(c, origin, direction, 0, 10, vacuum, w, counters);
                if (found && (!first || found->t_in < first->t_in)) first = found;
            }
            ++rays;
            hits += expected.has_value();
            different += first.has_value() != expected.has_value() ||
                         (first && std::abs(first->t_in - expected->t_in) > 8 * cells.resolution());
        }
    }
    MESSAGE(rays, " rays, ", hits, " hits");
    CHECK(hits > rays / 4);
    CHECK(different == 0);
}
