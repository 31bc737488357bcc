// Points of surfaces follow the pointer: for every number of the examples of all nodes that moves a visible point, the
// changed text is read again, and its surface must pass the pointer's ray within a pixel.
#include "view/drag.hpp"

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "phasetree/model/preparation_watch.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/scene.hpp"
#include "source_directory.hpp"
#include "studio/pointer.hpp"
#include "support/long_tests.hpp"

namespace test_drag {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::view;

namespace {

const studio::Vocabulary& vocabulary() {
    static const studio::Vocabulary words;
    return words;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A scene, its camera, and rays through its picture.
class Viewed {
  public:
    Viewed(const std::string& text, const std::string& name)
        : parse_([name](std::string now) { return Document::from_text(std::move(now), name); }),
          scene_(read_scene(parse_(text))),
          camera_(scene_.camera, scene_.film.resolution()),
          object(parse_(text), parse_),
          parameters(drag_parameters(object.document(), vocabulary(), object.size())),
          tracer_(scene_.object) {}

    // The surface that is seen at a place of the picture.
    std::optional<InterfacePoint> seen_at(const glm::dvec2& place) const {
        const CameraRay ray = camera_.generate(place, glm::vec2(0.5f));
        const auto crossing =
            tracer_.first_crossing(ray.origin, ray.direction, 0, 1e6f, std::nullopt, Evaluator::thread_workspace());
        if (!crossing) return std::nullopt;
        return InterfacePoint{crossing->to, crossing->from, glm::dvec3(crossing->p_from)};
    }
    DragTarget target(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec3& point) const {
        const auto ray = [&](const glm::dvec2& place) {
            const CameraRay r = camera_.generate(place, glm::vec2(0.5f));
            return std::pair(glm::dvec3(r.origin), glm::normalize(glm::dvec3(r.direction)));
        };
        const auto [origin, direction] = ray(to);
        const auto [start, facing] = ray(from);
        const auto [next_origin, next] = ray(from + glm::dvec2(1, 0));
        return {origin, direction, facing, glm::length(glm::cross(next, point - next_origin))};
    }
    // Whether the surface passes the pointer's ray within a pixel, for values of numbers. The text is read again.
    bool passes(const NumberEdits& values, const glm::dvec3& p, const InterfacePoint& grabbed,
                const DragTarget& target) const {
        if (!(glm::length(glm::cross(target.direction, p - target.origin)) <= 0.5 * target.pixel)) return false;
        const auto changed = VariedObject(object.document(), parse_).with(values);
        if (!changed) return false;
        const glm::dvec3 normal =
            glm::normalize(changed->interface_sample(p, grabbed.inside, grabbed.outside).gradient);
        for (const double reach : {0.25, 0.5})
            if (changed->label(p - reach * target.pixel * normal) == grabbed.inside &&
                changed->label(p + reach * target.pixel * normal) == grabbed.outside)
                return true;
        return false;
    }
    // The direction of a motion in the picture; to the right for one along the ray.
    glm::dvec2 direction_of(const Influence& one, const glm::dvec2& from, const glm::dvec3& p) const {
        const auto aside = [&](const glm::dvec2& place) {
            const CameraRay r = camera_.generate(place, glm::vec2(0.5f));
            const glm::dvec3 d = glm::normalize(glm::dvec3(r.direction)), o(r.origin);
            return (o - p) - d * glm::dot(o - p, d);
        };
        const glm::dvec3 here = aside(from), x = aside(from + glm::dvec2(1, 0)) - here,
                         y = aside(from + glm::dvec2(0, 1)) - here;
        const glm::dvec2 seen(glm::dot(one.motion, x) / glm::dot(x, x), glm::dot(one.motion, y) / glm::dot(y, y));
        const double length = glm::length(seen) * glm::length(x);
        return length > 0.05 * glm::length(one.motion) ? glm::normalize(seen) : glm::dvec2(1, 0);
    }
    glm::ivec2 resolution() const { return scene_.film.resolution(); }

  private:
    VariedObject::Parse parse_;
    Scene scene_;
    Camera camera_;

  public:
    VariedObject object;
    std::vector<DragParameter> parameters;

  private:
    InterfaceTracer tracer_;
};

// What became of the drags of a number.
struct Outcome {
    double strength = 0;
    int drags = 0, followed = 0;
};

// The kind of node that has a number: the last key of its pointer that is one.
std::string kind_of(const std::string& pointer) {
    std::string kind;
    for (const std::string& token : studio::pointer_tokens(pointer))
        if (vocabulary().find("field", token) || vocabulary().find("object", token)) kind = token;
    return kind;
}

// Drags points of an example by each number that moves them, forwards and backwards.
std::map<std::string, Outcome> drag_all(const Viewed& viewed, int spacing, std::size_t most_readings) {
    std::map<std::string, Outcome> outcomes;
    for (int y = spacing / 2; y < viewed.resolution().y; y += spacing)
        for (int x = spacing / 2; x < viewed.resolution().x; x += spacing) {
            const glm::dvec2 from(x + 0.3, y + 0.6);
            const auto point = viewed.seen_at(from);
            if (!point || viewed.object.readings() > most_readings) continue;
            for (const Influence& one : influences(viewed.object, *point, viewed.parameters)) {
                Outcome& outcome = outcomes[one.parameter.pointer];
                if (outcome.drags >= 6 || one.strength < 0.05) continue;
                const glm::dvec2 along = viewed.direction_of(one, from, point->position);
                for (const double pixels : {4.0, -4.0}) {
                    const DragTarget target = viewed.target(from, from + pixels * along, point->position);
                    const Dragged dragged = drag(viewed.object, *point, std::array{one.parameter}, target);
                    ++outcome.drags;
                    outcome.strength = std::max(outcome.strength, one.strength);
                    INFO(one.parameter.pointer, " from ", from.x, ", ", from.y, " by ", pixels, " pixels to ",
                         dragged.values.at(one.parameter.pointer));
                    if (dragged.follows) {
                        ++outcome.followed;
                        CHECK(viewed.passes(dragged.values, dragged.position, *point, target));
                    }
                }
            }
        }
    return outcomes;
}

}  // namespace

TEST_CASE("the surface follows the pointer within a pixel, for every number that moves it") {
    const std::filesystem::path nodes = std::filesystem::path(source_directory()) / "scenes/nodes";
    const std::string studio = text_of(nodes / "studio.json");
    int drags = 0, followed = 0, examples = 0, numbers = 0, never = 0;
    std::map<std::string, bool> kinds;  // whether any number of the kind follows
    for (const char* const folder : {"fields", "objects", "warps"})
        for (const auto& entry : std::filesystem::directory_iterator(nodes / folder)) {
            if (entry.path().extension() != ".json") continue;
            std::string text = studio;
            text.replace(text.find("@TREE@"), 6, text_of(entry.path()));
            const Viewed viewed(text, (nodes / "studio.json").string());
            const auto outcomes = drag_all(viewed, tests::long_tests() ? 11 : 23, tests::long_tests() ? 100'000 : 600);
            ++examples;
            for (const auto& [pointer, outcome] : outcomes) {
                if (outcome.drags == 0) continue;
                ++numbers;
                drags += outcome.drags;
                followed += outcome.followed;
                bool& follows = kinds[kind_of(pointer)];
                follows = follows || outcome.followed > 0;
                if (outcome.followed > 0) continue;
                ++never;
                MESSAGE(std::string(folder), "/", entry.path().stem().string(), ": ", pointer, " of strength ",
                        outcome.strength, " follows in none of ", outcome.drags, " drags");
            }
        }
    MESSAGE(followed, " of ", drags, " drags of ", numbers, " numbers of ", kinds.size(), " kinds in ", examples,
            " examples follow");
    // Where things are scattered is found by trial and error, and jumps when a number changes.
    for (const auto& [kind, follows] : kinds) CHECK_MESSAGE((follows || kind == "scatter"), kind);
    CHECK(kinds.size() >= 70);
    CHECK(examples > 110);
    // Some drags are impossible: the rim of a box cannot be lifted by making the box wider. Some numbers move points by
    // jumps, such as the spacing of voxels.
    CHECK(followed > 0.9 * drags);
    CHECK(never <= numbers / 50);
}

namespace {

// A ball and a box in front of a camera that looks along y.
const char* const ball_and_box =
    R"({"version": 1, "phases": {"glass": {"diffuse": {"color": [1, 1, 1]}}, "wood": {"diffuse": {"color": [1, 1, 1]}}},
    "tree": {"over": [
        {"set": {"phase": "glass", "of": {"translate": {"by": [-1, 0, 0], "of": {"sphere": {"radius": 0.5}}}}}},
        {"set": {"phase": "wood", "of": {"rotate": {"axis": [0, 0, 1], "angle": 10, "of": {"translate": {"by": [1, 0, 0],
            "of": {"box": {"size": [1, 1, 1]}}}}}}}}]},
    "lights": [{"constant": {}}], "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0], "fov": 30},
    "render": {"width": 300, "height": 200}})";
const std::string ball = "/tree/over/0/set/of/translate/", box = "/tree/over/1/set/of/rotate/";

const Influence& influence(const std::vector<Influence>& all, const std::string& pointer) {
    for (const Influence& one : all)
        if (one.parameter.pointer == pointer) return one;
    throw std::logic_error(pointer + " has no influence");
}

std::vector<DragParameter> parameters_of(const std::vector<Influence>& all, const std::set<std::string>& chosen = {}) {
    std::vector<DragParameter> result;
    for (const Influence& one : all)
        if (chosen.empty() || chosen.contains(one.parameter.pointer)) result.push_back(one.parameter);
    return result;
}

}  // namespace

TEST_CASE("derivatives by parameters agree with exact ones") {
    const Viewed viewed(ball_and_box, "scene.json");
    const InterfacePoint p = viewed.seen_at({100, 85}).value();
    const auto found = influences(viewed.object, p, viewed.parameters);
    REQUIRE(found.size() == 4);  // nothing of the box
    const glm::dvec3 normal = glm::normalize(p.position - glm::dvec3(-1, 0, 0));
    // f = |q − t| − r
    CHECK(influence(found, ball + "of/sphere/radius").slope == doctest::Approx(-1).epsilon(1e-3));
    CHECK(glm::distance(influence(found, ball + "of/sphere/radius").motion, normal) < 1e-3);
    for (int axis = 0; axis < 3; ++axis) {
        const Influence& by = influence(found, ball + "by/" + std::to_string(axis));
        CHECK(by.slope == doctest::Approx(-normal[axis]).epsilon(2e-3));
        glm::dvec3 unit(0);
        unit[axis] = 1;
        CHECK(glm::distance(by.motion, unit) < 1e-3);
    }
    // A rotation moves the points of the box around the axis.
    const InterfacePoint q = viewed.seen_at({210, 95}).value();
    const Influence turn = influence(influences(viewed.object, q, viewed.parameters), box + "angle");
    const glm::dvec3 around = glm::radians(1.0) * glm::dvec3(-q.position.y, q.position.x, 0);
    CHECK(glm::distance(turn.motion, around) < 2e-3 * glm::length(around));
}

TEST_CASE("a point sticks to the pointer, with the least change, and only chosen numbers change") {
    const Viewed viewed(ball_and_box, "scene.json");
    // A face of the box, which slides along itself.
    const glm::dvec2 from(190, 100), to(200, 90);
    const InterfacePoint p = viewed.seen_at(from).value();
    const auto found = influences(viewed.object, p, viewed.parameters);
    const DragTarget target = viewed.target(from, to, p.position);
    const Dragged all = drag(viewed.object, p, parameters_of(found), target);
    CHECK(all.follows);
    CHECK(all.sticks);
    CHECK(viewed.passes(all.values, all.position, p, target));
    const std::set<std::string> chosen{box + "of/translate/by/0", box + "of/translate/by/2"};
    const Dragged two = drag(viewed.object, p, parameters_of(found, chosen), target);
    CHECK(two.follows);
    CHECK(two.values.size() == 2);
    CHECK(two.values.at(box + "of/translate/by/2") == doctest::Approx(10 * target.pixel).epsilon(0.02));
    // Back where it began, nothing has changed.
    const Dragged none = drag(viewed.object, p, parameters_of(found), viewed.target(from, from, p.position));
    CHECK(none.follows);
    for (const auto& [pointer, value] : none.values)
        CHECK_MESSAGE(value == influence(found, pointer).parameter.value, pointer);
}

TEST_CASE("numbers stay within their limits, and near what they were when a point cannot follow") {
    const Viewed viewed(ball_and_box, "scene.json");
    const glm::dvec2 from(100, 85);
    const InterfacePoint p = viewed.seen_at(from).value();
    const auto found = influences(viewed.object, p, viewed.parameters);
    const auto radius = parameters_of(found, {ball + "of/sphere/radius"});
    // The picture is 4.8 m high. A ball around (−1, 0, 0) that passes the middle of the picture has the radius 1.
    for (const double x : {150.0, 250.0}) {
        const DragTarget target = viewed.target(from, {x, 100}, p.position);
        const Dragged dragged = drag(viewed.object, p, radius, target);
        if (dragged.follows) CHECK(viewed.passes(dragged.values, dragged.position, p, target));
        CHECK(dragged.values.begin()->second > 0);
        CHECK(dragged.values.begin()->second < 4);
    }
    // Nothing may change.
    const Dragged still = drag(viewed.object, p, {}, viewed.target(from, {150, 100}, p.position));
    CHECK_FALSE(still.follows);
    CHECK(still.values.empty());
}

TEST_CASE("a drag that takes too long can be cancelled") {
    const Viewed viewed(ball_and_box, "scene.json");
    const glm::dvec2 from(100, 85);
    const InterfacePoint p = viewed.seen_at(from).value();
    int polls = 0;
    const PreparationWatch watch({.cancelled = [&] { return ++polls > 5; }, .progress = {}});
    CHECK_THROWS_AS(influences(viewed.object, p, viewed.parameters), PreparationCancelled);
    CHECK_THROWS_AS(drag(viewed.object, p, viewed.parameters, viewed.target(from, {110, 90}, p.position)),
                    PreparationCancelled);
}

}  // namespace test_drag
