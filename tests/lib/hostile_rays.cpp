// Invalid or extreme rays that no camera sends: they find nothing, quickly.
#include <doctest/doctest.h>

#include <limits>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/pyramid.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/profiles/extrude.hpp"
#include "phasetree/nodes/profiles/polygon.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace test_hostile_rays {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

const Phased object =
    Under{.of = {Set{.phase = Phase{1}, .of = Sphere{}}, Set{.phase = Phase{2}, .of = Box{.size = {1, 1, 3}}}}};

/// The maximum number of batches for a ray that creeps along something that can be enclosed.
constexpr std::uint64_t max_batches = 5000;
/// The maximum for any ray, according to trace/creep.hpp: 524,288, plus some for each doubling of its steps.
constexpr std::uint64_t most_batches_at_all = 600'000;

}  // namespace

TEST_CASE("rays that are no rays meet nothing in bounded time") {
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    const float values[] = {not_a_number, infinity, -infinity, 0.f, 0.3f, -0.f, 1e30f, 1e-40f};
    const float distances[] = {0, 1, 100, 3e38f, infinity, not_a_number, -1};
    std::size_t crossings = 0;
    std::uint64_t most = 0;
    for (int bad = 0; bad < 6; ++bad) {
        for (const float value : {not_a_number, infinity, -infinity}) {
            for (const float other : values) {
                for (const float t_max : distances) {
                    for (const std::optional<Phase> carried : {std::optional<Phase>(), std::optional(vacuum),
                                                               std::optional(Phase{1}), std::optional(Phase{2})}) {
                        float ray[6] = {0.1f, 0.2f, 0.3f, 0, 0.6f, 0.8f};
                        ray[(bad + 1) % 6] = other;
                        ray[bad] = value;
                        TraceCounters c;
                        crossings += tracer
                                         .first_crossing({ray[0], ray[1], ray[2]}, {ray[3], ray[4], ray[5]}, 0, t_max,
                                                         carried, w, &c)
                                         .has_value();
                        most = std::max(most, c.batches);
                    }
                }
            }
        }
    }
    CHECK(crossings == 0);
    CHECK(most < max_batches);
}

TEST_CASE("a ray without a direction meets nothing") {
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    for (const glm::vec3& o : {glm::vec3(0), glm::vec3(0.9f, 0, 0), glm::vec3(1, 0, 0), glm::vec3(5, 0, 0)}) {
        for (const float t_max : {1.f, 1e6f, infinity}) {
            TraceCounters c;
            CHECK_FALSE(tracer.first_crossing(o, {0, 0, 0}, 0, t_max, {}, w, &c).has_value());
            CHECK_FALSE(tracer.first_crossing(o, {0, 0, 0}, 0, t_max, tracer.label(o, w), w, &c).has_value());
            CHECK(c.batches < 2 * max_batches);
        }
    }
}

TEST_CASE("an empty interval holds nothing") {
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    const glm::vec3 o{-5, 0, 0}, d{1, 0, 0};
    CHECK_FALSE(tracer.first_crossing(o, d, 10, 1, {}, w).has_value());
    CHECK_FALSE(tracer.first_crossing(o, d, not_a_number, 10, {}, w).has_value());
    CHECK_FALSE(tracer.first_crossing(o, d, 0, not_a_number, {}, w).has_value());
    CHECK_FALSE(tracer.first_crossing(o, d, infinity, infinity, {}, w).has_value());
    CHECK_FALSE(tracer.first_crossing(o, d, 0, 3.9f, {}, w).has_value());
    CHECK_FALSE(tracer.first_crossing(o, d, 7, 100, {}, w).has_value());
    CHECK(tracer.first_crossing(o, d, 0, 4.1f, {}, w).has_value());
    CHECK(tracer.first_crossing(o, d, 0, infinity, {}, w).has_value());
}

TEST_CASE("distances count from the ray's origin, whatever the interval") {
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    const glm::vec3 d{0, 1, 0};
    // From inside phase 2: its wall at 0.5, then the ball's at 1.
    for (const float t_min : {-10.f, -1.f, -0.1f, 0.f, 0.1f, 0.4f}) {
        CAPTURE(t_min);
        const auto hit = tracer.first_crossing({0, 0, 0}, d, std::max(t_min, 0.f), 100, {}, w);
        REQUIRE(hit);
        CHECK(hit->t_from <= 0.5f);
        CHECK(hit->t_to >= 0.5f);
        CHECK(hit->t_to - hit->t_from < 2 * tracer.resolution());
        CHECK(std::abs(hit->p_to.y - hit->t_to) < 1e-6f);
        if (t_min < 0) {
            // The interval reaches behind the origin: the first crossing within it is there.
            const auto behind = tracer.first_crossing({0, 0, 0}, d, t_min, 100, {}, w);
            REQUIRE(behind);
            CHECK(std::abs(behind->p_to.y - behind->t_to) < 1e-5f);
            CHECK(behind->t_to >= t_min);
        }
    }
}

TEST_CASE("a far origin costs no accuracy beyond its own rounding") {
    const InterfaceTracer tracer(object);
    Evaluator::Workspace w;
    for (const float far : {1e2f, 1e4f, 1e6f}) {
        const auto hit = tracer.first_crossing({-far, 0.6f, 0}, {1, 0, 0}, 0, infinity, vacuum, w);
        REQUIRE(hit);
        CHECK(std::abs(hit->p_to.x + 0.8f) < 4 * tracer.resolution());
        CHECK(hit->to == Phase{1});
    }
}

TEST_CASE("the work of one ray is bounded, also along an interface and for phantom zeros") {
    Random rng(95);
    Evaluator::Workspace w;
    std::uint64_t most = 0;
    for (int tree = 0; tree < 300; ++tree) {
        const Phased a = random_object(rng, 3 + tree % 3);
        std::optional<InterfaceTracer> tracer;
        try {
            tracer.emplace(a);
        } catch (const ModelError&) {
            continue;
        }
        for (int n = 0; n < 100; ++n) {
            const float size = tracer->bounds().diagonal();
            glm::vec3 d = rng.direction();
            glm::vec3 o = rng.in(tracer->bounds()) - d * size;
            if (rng.chance(0.4)) {
                d = glm::vec3(0);
                d[rng.below(3)] = 1;
                o = glm::round((rng.in(tracer->bounds()) - d * size) * 8.f) / 8.f;
            }
            TraceCounters c;
            (void)tracer->first_crossing(o, d, 0, infinity, {}, w, &c);
            most = std::max(most, c.batches);
        }
    }
    MESSAGE("most batches of one ray: ", most);
    CHECK(most < most_batches_at_all);
}

TEST_CASE("a ray creeps along any surface in bounded time, at any resolution, and then finds what is there") {
    const auto turned = [](Field f) { return warped(Rotate{.axis = {1, 2, 3}, .angle = 40}, std::move(f)); };
    const auto twisted = [](Field f) { return warped(Twist{.rate = 180}, std::move(f)); };
    const Field outline = Polygon{.points = {{-0.5f, -0.3f}, {0.5f, -0.3f}, {0.5f, 0.25f}, {-0.5f, 0.25f}}};
    struct Creep {
        std::string along;
        Field solid;
        glm::vec3 from, direction;
        std::uint64_t most;
    };
    const Creep creeps[] = {
        {"a face", Box{.size = glm::vec3(1)}, {-3, 0.1f, 0.5f}, {1, 0, 0}, max_batches},
        {"an edge", Box{.size = glm::vec3(1)}, {-3, 0.5f, 0.5f}, {1, 0, 0}, max_batches},
        {"a seam",
         Union{.of = {Box{.size = glm::vec3(1)}, warped(Translate{{0, 1, 0}}, Box{.size = glm::vec3(1)})}},
         {-3, 0.5f, 0.5f},
         {1, 0, 0},
         max_batches},
        {"a line of a cylinder", Cylinder{.radius = 0.5f, .height = 2}, {0.3f, 0.4f, -5}, {0, 0, 1}, max_batches},
        {"a twisted surface", twisted(Box{.size = {1, 0.5f, 2}}), {-3, 0.25f, 0}, {1, 0, 0}, max_batches},
        {"a pyramid's face", Pyramid{.base = 2, .height = 1}, {3, 0, -2.5f}, {-1, 0, 1}, max_batches},
        {"an outline", Extrude{.of = outline, .height = 1}, {-3, 0.25f, 0.1f}, {1, 0, 0}, most_batches_at_all},
    };
    Evaluator::Workspace w;
    for (const bool is_turned : {false, true}) {
        for (const Creep& creep : creeps) {
            CAPTURE(creep.along);
            CAPTURE(is_turned);
            const glm::vec3 d = glm::normalize(creep.direction);
            const float far = 6;
            const Field ball = warped(Translate{creep.from + far * d}, Sphere{.radius = 0.1f});
            const Field both = Union{.of = {creep.solid, ball}};
            const Field placed = is_turned ? turned(both) : both;
            // The same place of the ray in turned space.
            Rotate turn{.axis = {1, 2, 3}, .angle = 40};
            prepare(turn);
            const auto place = [&](const glm::vec3& p) { return is_turned ? turn.matrix * p : p; };
            const glm::vec3 o = place(creep.from), along = glm::normalize(place(d));
            const Phased object_of_creep = Set{.phase = Phase{1}, .of = placed};
            for (const float finer : {1.f, 8.f, 1000.f}) {
                CAPTURE(finer);
                const float chosen = InterfaceTracer(object_of_creep).resolution();
                const InterfaceTracer tracer(object_of_creep, chosen / finer);
                glm::vec3 from = o;
                Phase carried = vacuum;
                float passed = 0;
                std::uint64_t most = 0;
                bool is_found = false;
                // A ray within rounding of the surface may stay in it for a while.
                for (int n = 0; n < 100; ++n) {
                    TraceCounters c;
                    const auto hit = tracer.first_crossing(from, along, 0, infinity, carried, w, &c);
                    most = std::max(most, c.batches);
                    if (!hit) break;
                    passed += hit->t_to;
                    is_found = is_found || (hit->to == Phase{1} && std::abs(passed - (far - 0.1f)) < 1e-4f);
                    from = hit->p_to;
                    carried = hit->to;
                }
                CHECK(most < (finer > 1 ? most_batches_at_all : creep.most));
                if (finer > 1) continue;  // below floats' own resolution a ray may cross a face at each step
                CHECK(is_found);
                CHECK(most > 256);
            }
        }
    }
}

}  // namespace test_hostile_rays
