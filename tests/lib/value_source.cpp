// Which nodes a component of Φ comes from, against what is known of a few objects.
#include "phasetree/tree/value_source.hpp"

#include <doctest/doctest.h>

#include "phasetree/nodes/list.hpp"

namespace test_value_source {

using namespace phasetree;

namespace {

constexpr Phase water{1}, glass{2};

std::vector<std::string> names(const std::vector<NodeOnPath>& path) {
    std::vector<std::string> result;
    for (const NodeOnPath& step : path) result.emplace_back(step.name);
    return result;
}

Field ball_at(float x) {
    return warped(Translate{{x, 0, 0}}, Field(Sphere{.radius = 1}));
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("of a union the nearer solid gives the value") {
    const Field left = ball_at(-2), right = ball_at(2);
    const Phased object = Set{.phase = water, .of = Union{.of = {left, right}}};
    for (const float x : {-4.f, -1.f, -0.1f})
        CHECK(value_source(object, {x, 0.3f, 0}, water).at(2).node == left.node());
    for (const float x : {4.f, 1.f, 0.1f}) CHECK(value_source(object, {x, 0.3f, 0}, water).at(2).node == right.node());
    CHECK(names(value_source(object, {3, 0, 0}, water)) == Names{"set", "union", "translate", "sphere"});
    // The vacuum around it has the same source.
    CHECK(value_source(object, {3, 0, 0}, vacuum).at(2).node == right.node());
}

TEST_CASE("of a difference what is cut away gives the value at the cut") {
    const Field cut = ball_at(1);
    const Phased object = Set{.phase = water, .of = Difference{.from = Sphere{.radius = 1}, .subtract = {cut}}};
    CHECK(value_source(object, {0.01f, 0, 0}, water).at(2).node == cut.node());
    CHECK(names(value_source(object, {-0.99f, 0, 0}, water)) == Names{"set", "difference", "sphere"});
}

TEST_CASE("of a blend the larger part gives the value, and a profile's bound that is a number never does") {
    const Field left = ball_at(-0.9f), right = ball_at(0.9f);
    const Phased object = Set{.phase = water, .of = SmoothUnion{.of = {left, right}, .radius = 0.5f}};
    CHECK(value_source(object, {-1.5f, 0.8f, 0}, water).at(2).node == left.node());
    CHECK(value_source(object, {1.5f, 0.8f, 0}, water).at(2).node == right.node());
    const Phased rod = Set{.phase = water, .of = Extrude{.of = Circle{.radius = 1}, .height = 2}};
    CHECK(names(value_source(rod, {1.01f, 0, 0}, water)).back() == "circle");
}

TEST_CASE("where two phases meet each component has its source, and an absent one has none") {
    const Phased inner = Set{.phase = water, .of = Sphere{.radius = 1}};
    const Phased outer = Set{.phase = glass, .of = Box{.size = glm::vec3(4)}};
    const Phased object = Over{.of = {inner, outer}};
    CHECK(names(value_source(object, {0.99f, 0, 0}, water)).back() == "sphere");
    CHECK(names(value_source(object, {0.99f, 0, 0}, glass)).back() == "sphere");
    CHECK(names(value_source(object, {1.99f, 0, 0}, glass)).back() == "box");
    CHECK(value_source(object, {0, 0, 0}, Phase{3}).empty());
}

TEST_CASE("shapes of shapes that stand for billions end with an error") {
    Field shape = Sphere{.radius = 1};
    for (int i = 0; i < 40; ++i) shape = Union{.of = {shape, warped(Translate{{0, 0, 1}}, shape)}};
    CHECK_THROWS_AS(value_source(Set{.phase = water, .of = shape}, {}, water), ModelError);
}

}  // namespace test_value_source
