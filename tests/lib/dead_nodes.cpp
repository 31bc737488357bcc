// Effects of nodes: those that change nothing are proved dead, all others are refuted with a point, and no node of a
// random tree is proved dead against samples.
#include "phasetree/measuring/node_effects.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/measuring/prove.hpp"
#include "phasetree/nodes/list.hpp"
#include "support/long_tests.hpp"
#include "support/random_tree.hpp"
#include "support/simple_shapes.hpp"

namespace test_dead_nodes {

using namespace phasetree;
using namespace phasetree::tests;
using simple::ball, simple::glass, simple::iron, simple::Point, simple::set, simple::water;
using Random = simple::UniformReals;

namespace {

// What is known of leaving out each node that is one of the planted ones. Labels with and without the node are compared
// at random points by walking both trees.
void check_effects(const Phased& object, const std::vector<AnyNode>& dead, double size, Random& random) {
    const std::vector<NodeEffect> effects = node_effects(object);
    std::size_t dead_found = 0;
    for (const NodeEffect& e : effects) {
        CAPTURE(std::string(name_of(e.node)));
        const bool is_planted = std::ranges::any_of(
            dead, [&](const AnyNode& node) { return phasetree::address_of(node) == phasetree::address_of(e.node); });
        CHECK(e.is_dead == (is_planted ? phasetree::Verdict::proved : phasetree::Verdict::refuted));
        dead_found += is_planted ? 1 : 0;
        REQUIRE(e.without);
        const auto label_in = [](const Phased& tree, const glm::vec3& p) { return label(distances(tree, p)); };
        if (const auto& c = e.change) {
            CHECK(label_in(object, c->point) == c->with);
            CHECK(label_in(e.without, c->point) == c->without);
            CHECK(c->with != c->without);
        }
        if (e.is_dead != phasetree::Verdict::proved) continue;
        for (int i = 0; i < 2000; ++i) {
            const glm::vec3 p(Point(random(-size, size), random(-size, size), random(-size, size)));
            CHECK(label_in(object, p) == label_in(e.without, p));
        }
    }
    CHECK(dead_found == dead.size());
}

}  // namespace

TEST_CASE("nodes that change nothing are proved dead, and all others are refuted with a point") {
    for (int i = 0; i < (long_tests() ? 60 : 6); ++i) {
        CAPTURE(i);
        Random random{std::mt19937(static_cast<unsigned>(600 + i))};
        const double radius = random(0.6, 1), small = random(0.1, 0.25);
        const Point in = random.direction() * random(0, 0.9 * (radius - small));
        const Field large = Sphere{.radius = static_cast<float>(radius)}, other = ball({1.2, 0, 0}, 0.7);
        const Field inner = ball(in, small), far = ball({-3, 0, 0}, 0.5), around = Sphere{.radius = 4};
        check_effects(set(glass, Union{.of = {large, inner, other}}), {inner}, 2, random);
        // Beyond the radius of a smooth union.
        const Field deep = ball(in * 0.3, 0.5 * small);
        check_effects(set(glass, SmoothUnion{.of = {large, other, deep}, .radius = 0.05f}), {deep}, 2, random);
        check_effects(set(glass, Intersection{.of = {large, around, other}}), {around}, 2, random);
        check_effects(set(glass, Difference{.from = large, .subtract = {other, far}}), {far}, 4, random);
        check_effects(set(glass, Difference{.from = large, .subtract = {far}}), {far}, 4, random);
        // A phase that another one swallows.
        const Phased hidden = set(iron, inner);
        check_effects(Over{.of = {set(glass, large), hidden, set(water, other)}}, {hidden}, 2, random);
        // The same twice: each is dead as long as the other one stays.
        const Field again = ball({1.2, 0, 0}, 0.7);
        check_effects(set(glass, Union{.of = {large, other, again}}), {other, again}, 2, random);
        const Phased cut = IntersectShape{.of = set(glass, large), .shape = around};
        check_effects(Over{.of = {cut, set(water, other)}}, {around}, 2, random);
    }
}

TEST_CASE("no node of a random tree that changes a label is proved dead") {
    Random random{std::mt19937(700)};
    int dead = 0, refuted = 0;
    for (int i = 0; i < (long_tests() ? 200 : 12); ++i) {
        CAPTURE(i);
        tests::Random seeded(static_cast<unsigned>(800 + i));
        const Phased object = IntersectShape{.of = random_object(seeded, 4), .shape = Sphere{.radius = 2.5f}};
        NodeEffectsOptions options;
        options.max_boxes = 256;
        const Bounds box = bounds(object);
        if (box.empty() || !box.finite()) continue;
        for (const NodeEffect& e : node_effects(object, options)) {
            dead += e.is_dead == phasetree::Verdict::proved;
            refuted += e.is_dead == phasetree::Verdict::refuted;
            if (const auto& c = e.change) {
                CHECK(label(distances(object, c->point)) == c->with);
                CHECK(label(distances(e.without, c->point)) == c->without);
            }
            if (e.is_dead != phasetree::Verdict::proved) continue;
            for (int k = 0; k < 1000; ++k) {
                glm::vec3 p;
                for (int axis = 0; axis < 3; ++axis)
                    p[axis] = static_cast<float>(
                        random(static_cast<double>(box.low[axis]), static_cast<double>(box.high[axis])));
                const Phases<float> with = distances(object, p);
                if (label(with) == label(distances(e.without, p))) continue;
                // On a surface, rounding decides.
                CHECK(std::abs(with[label(with).index]) < 1e-5f * box.diagonal());
            }
        }
    }
    MESSAGE(dead, " nodes are dead, ", refuted, " are not");
    CHECK(dead > 3);
    CHECK(refuted > 20);
}

TEST_CASE("an object without dead nodes is proved to be one, and another refuted") {
    ProveOptions options;
    options.resolution = 0.1;
    const std::vector<Statement> statements{HasNoDeadNodes{}, IsPresent{glass}};
    const std::vector<Proof> sound =
        prove(set(glass, Union{.of = {Sphere{}, ball({1, 0, 0}, 1)}}), statements, options);
    CHECK(sound[0].verdict == phasetree::Verdict::proved);
    CHECK(sound[0].nodes.size() == 3);
    const std::vector<Proof> dead =
        prove(set(glass, Union{.of = {Sphere{}, ball({0.2, 0, 0}, 0.5)}}), statements, options);
    CHECK(dead[0].verdict == phasetree::Verdict::refuted);
    CHECK(dead[0].reason == "1 of 2 nodes change no label");
    CHECK(dead[1].verdict == phasetree::Verdict::proved);
    const std::vector<NodeEffect> still = node_effects(set(glass, ball({}, 1)));  // translated by 0
    REQUIRE(still.size() == 1);
    CHECK(still[0].is_dead == phasetree::Verdict::proved);
    CHECK(still[0].is_replaced());
    NodeEffectsOptions none;
    none.seconds = 0;
    CHECK_THROWS_AS((void)node_effects(set(glass, ball({}, 1)), none), ModelError);
    CHECK_THROWS_AS((void)node_effects(set(glass, Plane{})), ModelError);
}

}  // namespace test_dead_nodes
