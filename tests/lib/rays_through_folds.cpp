// Rays that creep along endless copies: enclosures along such rays reach places where the fold of space jumps.
#include <doctest/doctest.h>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/endless_grid.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace test_rays_through_folds {

using namespace phasetree;
using namespace phasetree::tests;

// Slabs whose tops are at z = 0.1, each with a bump at its end that reaches up to z = 0.3. A ray that starts on the top
// of one slab, beyond its bump, creeps to the gap and on to the bump of the next slab.
TEST_CASE("a ray that creeps along endless copies meets the bump of the next one") {
    constexpr float spacing = 1, half_slab = 0.49f, half_bump = 0.05f, top = 0.1f;
    const Field slab = Box{.size = {2 * half_slab, 0.8f, 2 * top}};
    const Field bump =
        warped(Translate{{half_bump - half_slab, 0, 0}}, Field(Box{.size = {2 * half_bump, 0.8f, 0.6f}}));
    const Phased object =
        IntersectShape{.of = Set{.phase = Phase{1},
                                 .of = FieldEndlessGrid{{.of = Union{.of = {slab, bump}}, .spacing = {spacing, 0, 0}}}},
                       .shape = Box{.size = {12, 2, 2}}};
    const InterfaceTracer tracer(object, 1e-6f);
    Evaluator::Workspace workspace;
    Random rng(7);
    int creeping = 0, wrong = 0;
    for (int n = 0; n < (long_tests() ? 100'000 : 2000); ++n) {
        const auto cell = static_cast<float>(rng.below(7) - 3);
        const float x = cell * spacing + rng.uniform(-0.3f, 0.4f), y = rng.uniform(-0.3f, 0.3f);
        const float height = rng.uniform(0, 1.5e-6f), slope = rng.uniform(0, 1e-6f);
        const glm::vec3 origin(x, y, top + height), direction = glm::normalize(glm::vec3(1, 0, slope));
        if (tracer.label(origin, workspace) != vacuum) continue;
        ++creeping;
        const auto hit = tracer.first_crossing(origin, direction, 0, 10, vacuum, workspace);
        const float expected = (cell + 1) * spacing - half_slab;
        if (!hit || std::abs(origin.x + hit->t_from * direction.x - expected) > 1e-5f) ++wrong;
    }
    CHECK(creeping > 1000);
    CHECK(wrong == 0);
}

}  // namespace test_rays_through_folds
