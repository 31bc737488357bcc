// Objects, groups and cameras that move while the shutter is open: their positions over time, against closed forms;
// their bounding boxes; rays at any time, against one tree of the objects at that time; and impossible motions.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "phasetree/io/document.hpp"
#include "phasetree/io/error.hpp"
#include "scene/one_tree.hpp"
#include "scene/read_transform.hpp"
#include "support/long_tests.hpp"
#include "tracer/support/straight_rays.hpp"

namespace test_moving_objects {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

Document document_of(const std::string& objects, const std::string& camera = R"("position": [0, -50, 0])") {
    return Document::from_text(R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}},
        "water": {"clear": {"ior": 1.3}}, "oil": {"clear": {"ior": 1.4}}},)" +
                                   objects + R"(, "lights": [{"constant": {}}], "render": {"shutter": [1, 3]},
        "camera": {"look_at": [0, 0, 0], )" +
                                   camera + "}}",
                               "test.json");
}

MovingTransform moving_of(const std::string& text, const Shutter& shutter = {0, 1}) {
    const Document document = Document::from_text(text);
    return read_transform(document, document.root(), shutter).moving.value();
}

double distance(const Transform& a, const Transform& b) {
    double most = glm::length(a.by - b.by);
    for (int i = 0; i < 3; ++i) most = std::max(most, glm::length(a.matrix[i] - b.matrix[i]));
    return most;
}

// A random transform. In one series, all transforms mirror or none does.
std::string random_transform(Random& random, bool mirrors, float far) {
    const glm::vec3 axis = direction(random);
    return fmt::format(
        R"([{{"affine": {{"x": [{}, 0, 0], "y": [{}, 1, 0]}}}}, {{"rotate": {{"axis": [{}, {}, {}], "angle": {}}}}},
            {{"scale": {{"factor": {}}}}}, {{"translate": {{"by": [{}, {}, {}]}}}}])",
        mirrors ? -1 : 1, uniform(random, -0.2f, 0.2f), axis.x, axis.y, axis.z, uniform(random, 0, 360),
        uniform(random, 0.8f, 1.2f), uniform(random, -far, far), uniform(random, -far, far),
        uniform(random, -far, far));
}

// Two to four keys within or around the time in which the shutter is open.
std::string random_keys(Random& random, float far) {
    const bool mirrors = random() % 2 == 0;
    std::string text = R"({"keys": [)";
    const auto count = 2 + random() % 3;
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format("{}[{}, {}]", i > 0 ? ", " : "", 0.5 + static_cast<double>(i) + uniform(random, 0, 0.9f),
                            random_transform(random, mirrors, far));
    return text + "]}";
}

Transform turned(double degrees, double scale, const glm::dvec3& by) {
    const double a = degrees * std::numbers::pi / 180, c = scale * std::cos(a), s = scale * std::sin(a);
    return {glm::dmat3(c, s, 0, -s, c, 0, 0, 0, scale), by};
}

}  // namespace

TEST_CASE("between keys a transform turns evenly, goes straight, and is scaled evenly") {
    const MovingTransform moving = moving_of(R"({"keys": [[0, {"translate": {"by": [1, 2, 3]}}],
        [1, [{"scale": {"factor": 3}}, {"rotate": {"angle": 120}}, {"translate": {"by": [3, 2, -1]}}]]]})");
    for (double t = 0; t <= 1; t += 0.01)
        CHECK(distance(moving.at(t), turned(120 * t, 1 + 2 * t, {1 + 2 * t, 2, 3 - 4 * t})) < 1e-6);
    // The shorter way, and mirrored at all times.
    const MovingTransform back = moving_of(R"({"keys": [[0, {"affine": {"x": [-1, 0, 0]}}],
        [1, [{"affine": {"x": [-1, 0, 0]}}, {"rotate": {"angle": 300}}]]]})");
    for (double t = 0; t <= 1; t += 0.01)
        CHECK(distance(back.at(t), turned(-60 * t, 1, {}) * Transform{glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1), {}}) <
              1e-6);
    // With keys of an angle, the rotation is as large as the angle: two turns while the shutter is open.
    const MovingTransform twice = moving_of(R"({"rotate": {"angle": {"keys": [[1, 0], [3, 720]]}}})", {1, 3});
    for (double t = 0; t <= 1; t += 0.01) CHECK(distance(twice.at(t), turned(720 * t, 1, {})) < 1e-5);
}

TEST_CASE("transforms are what their poses say, whatever they are") {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        CAPTURE(i);
        const Document document = Document::from_text(random_transform(random, i % 2 == 0, 3));
        Transform transform = read_transform(document, document.root());
        // Also nearly flat.
        if (i % 3 == 0) transform.matrix = transform.matrix * glm::dmat3(1, 0, 0, 0, 1e-5, 0, 0.3, 0, 1);
        const Pose pose = Pose::of(transform);
        CHECK(distance(pose.transform(), transform) < 1e-9);
        CHECK(std::abs(glm::length(pose.turn) - 1) < 1e-12);
        CHECK(pose.mirrors() == (i % 2 == 0));
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < k; ++j) CHECK(std::abs(pose.stretch[k][j] - pose.stretch[j][k]) < 1e-12);
    }
}

TEST_CASE("a box that is swept holds all that moves, and is not much larger") {
    Random random(9);
    for (int i = 0; i < 300; ++i) {
        CAPTURE(i);
        const MovingTransform moving = moving_of(random_keys(random, 4), {1, 3});
        const Bounds box{glm::vec3(-1, -0.5f, -2), glm::vec3(1, 2, 0.5f)};
        const Bounds all = moving.swept(box);
        Bounds met;
        for (int k = 0; k < 400; ++k) {
            const double time = static_cast<double>(uniform(random, 0, 1));
            CHECK(moving.stretch() >= moving.at(time).stretch() * 0.75);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 p(moving.at(time)(box.corner(corner)));
                CHECK(all.contains(p));
                met = unite(met, {p, p});
            }
        }
        CHECK(all.diagonal() < 1.3f * met.diagonal());
    }
}

TEST_CASE("rays at any time through moving, nested, mirrored and scaled objects are as through one tree of them") {
    Random random(3);
    std::string text = R"("objects": [
        {"name": "bead", "tree": {"under": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 0.95}}}},
                                            {"set": {"phase": "water", "of": {"box": {"size": [0.7, 0.8, 0.9]}}}}]},
         "transform": )" +
                       random_keys(random, 0.2f) +
                       R"(},
        {"name": "ring", "tree": {"set": {"phase": "oil", "of": {"torus": {"major": 0.6, "minor": 0.25}}}}}],
        "groups": {"pair": [{"of": "bead"}, {"of": "ring", "transform": [)" +
                       R"({"translate": {"by": [0, 3, 0]}}, {"rotate": {"angle": {"keys": [[0, 0], [3, 200]]}}}]}],
                   "four": [{"of": "pair", "transform": )" +
                       random_keys(random, 0.4f) + R"(}, {"of": "pair", "transforms": [[9, 0, 0], [0, 0, 9]]}]},
        "instances": [)";
    for (int i = 0; i < 6; ++i)
        text += fmt::format(R"({}{{"of": "group{}", "transforms": [[{}, {}, 0]]}})", i > 0 ? ", " : "", i, 24 * (i % 3),
                            24 * (i / 3));
    text += "]";
    // Each of the six is in its own moving group.
    std::string groups;
    for (int i = 0; i < 6; ++i)
        groups += fmt::format(R"("group{}": [{{"of": "{}", "transform": {}}}], )", i, i % 2 == 0 ? "four" : "pair",
                              random_keys(random, 0.7f));
    text.insert(text.find("\"pair\": ["), groups);
    const Scene several = read_scene(document_of(text));
    REQUIRE(several.moves());
    const TracedGeometry geometry(several);
    std::size_t crossings = 0;
    const int count = phasetree::tests::long_tests() ? 20'000 : 1500;
    for (const float time : {0.0f, 0.137f, 0.41f, 0.5f, 0.77f, 0.999f}) {
        CAPTURE(time);
        Scene one = several;
        one.object = as_one_tree(several.placed, static_cast<double>(time));
        one.placed = {};
        const TracedGeometry tree(one);
        const double resolution = static_cast<double>(tree.object().resolution());
        const Bounds& box = tree.bounds();
        for (int i = 0; i < count; ++i) {
            CAPTURE(i);
            glm::vec3 target;
            // Most of the box is empty.
            for (int attempt = 0; attempt < 100 && (attempt == 0 || tree.label(target) == phasetree::vacuum); ++attempt)
                for (int axis = 0; axis < 3; ++axis) target[axis] = uniform(random, box.low[axis], box.high[axis]);
            const glm::vec3 d = direction(random);
            const glm::vec3 origin = i % 2 == 0 ? target - 90.0f * d : target;
            if (geometry.label(origin, time) != tree.label(origin)) {
                // Only closer to an interface than the precision with which both know it.
                bool is_near = false;
                for (int k = 0; k < 6; ++k) {
                    glm::vec3 aside(0.0f);
                    aside[k / 2] = (k % 2 == 0 ? 2 : -2) * static_cast<float>(resolution);
                    is_near = is_near || tree.label(origin + aside) != tree.label(origin);
                }
                CHECK(is_near);
                continue;
            }
            crossings += check_same_steps(straight_through(geometry, origin, d, time),
                                          straight_through(tree, origin, d), resolution);
        }
    }
    CHECK(crossings > 2000);
}

TEST_CASE("objects that touch while they move touch for every ray: no vacuum is between them") {
    const std::string path = R"({"keys": [[0, {"translate": {"by": [-3, 1, 0]}}],
        [4, [{"rotate": {"axis": [1, 2, 3], "angle": 140}}, {"scale": {"factor": 1.3}}, {"translate": {"by": [5, 0, 2]}}]]]})";
    const Scene scene = read_scene(document_of(R"("objects": [
        {"name": "shell", "tree": {"subtract_shape": {"of": {"set": {"phase": "glass",
            "of": {"sphere": {"radius": 1}}}}, "shape": {"sphere": {"radius": 0.8}}}}},
        {"name": "drop", "transform": {"scale": {"factor": 0.5}},
         "tree": {"set": {"phase": "water", "of": {"sphere": {"radius": 1.6}}}}}],
        "groups": {"both": [{"of": "shell"}, {"of": "drop"}]}, "instances": [{"of": "both", "transform": )" +
                                               path + "}]"));
    const TracedGeometry geometry(scene);
    Random random(3);
    for (int i = 0; i < 5000; ++i) {
        CAPTURE(i);
        const float time = uniform(random, 0, 1);
        const Transform to_scene = scene.placed.moving.front().at(static_cast<double>(time));
        const glm::vec3 d = direction(random);
        const glm::dvec3 inner = 0.75 * glm::dvec3(direction(random)) * static_cast<double>(uniform(random, 0, 1));
        const glm::vec3 from = glm::vec3(to_scene(inner)) - 4.0f * d;
        std::string met;
        for (const Step& step : straight_through(geometry, from, d, time)) met += scene.phases[step.to] + " ";
        CHECK(met == "glass water glass vacuum ");
    }
}

TEST_CASE("a camera that moves is at each time the one that the file has then") {
    const std::string camera = R"("position": {"keys": [[0, [0, -50, 0]], [2, [10, -40, 5]], [4, [0, -30, 5]]]},
        "fov": {"keys": [[1, 30], [3, 50]], "between": "smooth"}, "lens_radius": 0.2,
        "focus_distance": {"keys": [[0, 20], [4, 50]]}, "up": {"keys": [[0, [0, 0, 1]], [4, [1, 0, 0.5]]]})";
    const Document document = document_of(R"("objects": [{"name": "a", "tree": {"set": {"phase": "glass",
        "of": {"sphere": {"radius": 1}}}}}])",
                                          camera);
    const Scene scene = read_scene(document);
    REQUIRE(scene.moves());
    const MovingCamera moving(scene.camera, scene.camera_moments, {64, 48});
    CHECK_FALSE(moving.single_origin());
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const double time = static_cast<double>(uniform(random, 0, 1));
        Scene then = read_scene(document.at(2 * time));
        const Camera still(then.camera, {64, 48});
        const glm::dvec2 film(uniform(random, 0, 64), uniform(random, 0, 48));
        const glm::vec2 lens(uniform(random, 0, 1), uniform(random, 0, 1));
        const CameraRay a = moving.generate(film, lens, time), b = still.generate(film, lens);
        CHECK(glm::length(a.origin - b.origin) < 2e-3f);
        CHECK(glm::length(a.direction - b.direction) < 1e-3f);
        CHECK(glm::length(a.origin - position_of(then.camera)) < 0.21f);
    }
}

TEST_CASE("what cannot move is rejected, with the place") {
    const auto message = [](const std::string& transform, const std::string& shutter = "[0, 1]",
                            const std::string& phase = "water") {
        try {
            (void)read_scene(Document::from_text(R"({"version": 1,
"phases": {"fog": {"clear": {"ior": 1, "scattering": [2, 2, 2], "density": {"sphere": {"radius": 1}}, "density_depth": 0.3}}, "water": {"clear": {"ior": 1.33}}},
"objects": [{"name": "ball", "tree": {"set": {"phase": ")" +
                                                 phase + R"(", "of": {"sphere": {"radius": 1}}}},
"transform": )" + transform + R"(}],
"lights": [{"constant": {}}], "render": {"shutter": )" +
                                                 shutter + R"(},
"camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]}})"));
        } catch (const SceneError& e) {
            return fmt::format("{}: {}", e.line(), e.what());
        }
        return std::string();
    };
    const auto refused = [&](const std::string& text, int line, const std::string& why) {
        CAPTURE(text);
        CHECK(text.starts_with(std::to_string(line) + ": "));
        CHECK(text.find(why) != std::string::npos);
    };
    const std::string good = R"({"keys": [[0, {"scale": {"factor": 1}}], [1, {"scale": {"factor": 2}}]]})";
    CHECK(message(good) == "");
    CHECK(message(good, "[0, 0]") == "");
    refused(message(good, "[1, 0]"), 5, "the shutter must not close before it opens");
    refused(message(good, "[0, 1e9]"), 5, "shutter");
    refused(message(R"({"keys": [[0, {"scale": {"factor": 1}}]]})"), 4, "two or more");
    refused(message(R"({"keys": [[1, {"scale": {"factor": 1}}], [0, {"scale": {"factor": 2}}]]})"), 4, "later than");
    refused(message(R"({"keys": [[0, {"scale": {"factor": 1}}], [1, {"affine": {"x": [-1, 0, 0]}}]]})"), 4,
            "become singular");
    refused(message(R"({"affine": {"x": {"keys": [[0, [1, 0, 0]], [0.99, [-1, 0, 0]]]}}})"), 4, "become singular");
    refused(message(R"({"keys": [[0, {"scale": {"factor": 1}}], [1, {"scael": {"factor": 1}}]]})"), 4, "scale");
    refused(message(R"({"translate": {"by": {"keys": [[0, [0, 0, 0]], [0.001, [1e30, 0, 0]]]}}})"), 4, "");
}

}  // namespace test_moving_objects
