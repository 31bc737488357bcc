// Rays through several objects: the same as through one tree of these objects, and correct where objects touch.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>

#include "phasetree/io/document.hpp"
#include "scene/one_tree.hpp"
#include "support/long_tests.hpp"
#include "tracer/support/straight_rays.hpp"
#include "world/world.hpp"

namespace test_several_objects {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

Scene scene_of(const std::string& objects) {
    return read_scene(Document::from_text(R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}},
        "water": {"clear": {"ior": 1.3}}, "oil": {"clear": {"ior": 1.4}}},)" +
                                              objects + R"(, "lights": [{"constant": {}}],
        "camera": {"position": [0, -50, 0], "look_at": [0, 0, 0]}})",
                                          "test.json"));
}

/// A random rotation, stretch and reflection as a list of transforms, which map the unit ball to within 0.45 of
/// `place`.
std::string random_place(Random& random, const glm::vec3& place) {
    const glm::vec3 axis = direction(random);
    const float size = std::exp2(uniform(random, -3, -1.2f));
    const std::string mirrored = uniform(random, 0, 1) < 0.5f ? R"({"affine": {"x": [-1, 0, 0]}}, )" : "";
    return fmt::format(
        R"([{}{{"stretch": {{"factors": [1, {}, 0.9]}}}}, {{"rotate": {{"axis": [{}, {}, {}], "angle": {}}}}},
                           {{"scale": {{"factor": {}}}}}, {{"translate": {{"by": [{}, {}, {}]}}}}])",
        mirrored, uniform(random, 0.7f, 1), axis.x, axis.y, axis.z, uniform(random, 0, 360), size, place.x, place.y,
        place.z);
}

/// 1,000 objects that do not overlap: rows of ten, of three kinds; ten rows per layer; ten layers. Each row and each
/// layer is rotated, mirrored and scaled.
std::string thousand_objects(Random& random) {
    std::string text = R"("objects": [
        {"name": "bead", "tree": {"under": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 0.95}}}},
                                            {"set": {"phase": "water", "of": {"box": {"size": [0.7, 0.8, 0.9]}}}}]}},
        {"name": "ring", "tree": {"set": {"phase": "oil", "of": {"torus": {"major": 0.6, "minor": 0.25}}}}},
        {"name": "bar", "tree": {"set": {"phase": "glass", "of": {"box": {"size": [1.2, 0.8, 0.9]}}}}}],
        "groups": {)";
    const char* const kinds[] = {"bead", "ring", "bar"};
    for (int row = 0; row < 3; ++row) {
        text += fmt::format(R"("row{}": [)", row);
        for (int i = 0; i < 10; ++i)
            text += fmt::format(R"({}{{"of": "{}", "transform": {}}})", i > 0 ? ", " : "", kinds[random() % 3],
                                random_place(random, glm::vec3(static_cast<float>(i) - 4.5f, 0, 0)));
        text += "], ";
    }
    for (int layer = 0; layer < 2; ++layer) {
        text += fmt::format(R"("layer{}": [)", layer);
        for (int i = 0; i < 10; ++i)
            text += fmt::format(
                R"({}{{"of": "row{}", "transform": [{{"rotate": {{"axis": [1, 0, 0], "angle": {}}}}},
                   {{"affine": {{"x": [{}, 0, 0]}}}}, {{"translate": {{"by": [0, {}, 0]}}}}]}})",
                i > 0 ? ", " : "", random() % 3, uniform(random, 0, 360), random() % 2 == 0 ? 1 : -1,
                static_cast<float>(i) - 4.5f);
        text += layer == 0 ? "], " : "]}, ";
    }
    text += R"("instances": [)";
    for (int i = 0; i < 10; ++i)
        text += fmt::format(
            R"({}{{"of": "layer{}", "transform": [{{"rotate": {{"axis": [0, 0, 1], "angle": {}}}}},
               {{"translate": {{"by": [0, 0, {}]}}}}, {{"scale": {{"factor": 0.8}}}}]}})",
            i > 0 ? ", " : "", random() % 2, 90 * static_cast<int>(random() % 4), static_cast<float>(i) - 4.5f);
    return text + "]";
}

}  // namespace

TEST_CASE("rays through 1,000 nested, scaled and mirrored objects are as through one tree of them") {
    Random random(7);
    const Scene several = scene_of(thousand_objects(random));
    REQUIRE(several.placed.copies() == 1000);
    Scene one = several;
    one.object = as_one_tree(several.placed);
    one.placed = {};
    const TracedGeometry geometry(several), tree(one);
    const double resolution = static_cast<double>(tree.object().resolution());
    const int count = phasetree::tests::long_tests() ? 200'000 : 20'000;
    std::size_t crossings = 0;
    for (int i = 0; i < count; ++i) {
        CAPTURE(i);
        const glm::vec3 target(uniform(random, -4, 4), uniform(random, -4, 4), uniform(random, -4, 4));
        const glm::vec3 d = direction(random);
        const glm::vec3 origin = i % 2 == 0 ? target - 12.0f * d : target;
        REQUIRE(geometry.label(origin) == tree.label(origin));
        // Both are compared at the tree's resolution, which is the coarser one.
        crossings +=
            check_same_steps(straight_through(geometry, origin, d), straight_through(tree, origin, d), resolution);
    }
    CHECK(crossings > 2 * static_cast<std::size_t>(count));
}

TEST_CASE("where objects touch, a ray goes from phase to phase and is in no vacuum between") {
    // A shell of glass with a ball of water in it that was modelled at another size, and a block of oil on a block of
    // glass. Everything is rotated, and far from the origin.
    const std::string at = R"([{"rotate": {"axis": [1, 2, 3], "angle": 77}}, {"translate": {"by": [20, -30, 15]}}])";
    const std::string at_half = R"([{"scale": {"factor": 0.5}}, )" + at.substr(1);
    const Scene scene = scene_of(R"("objects": [
        {"name": "shell", "transform": )" +
                                 at + R"(, "tree": {"subtract_shape": {"of": {"set": {"phase": "glass",
            "of": {"sphere": {"radius": 1}}}}, "shape": {"sphere": {"radius": 0.8}}}}},
        {"name": "drop", "transform": )" +
                                 at_half +
                                 R"(, "tree": {"set": {"phase": "water", "of": {"sphere": {"radius": 1.6}}}}},
        {"name": "low", "transform": )" +
                                 at + R"(, "tree": {"set": {"phase": "glass",
            "of": {"translate": {"by": [5, 0, 0], "of": {"box": {"size": [2, 2, 2]}}}}}}},
        {"name": "high", "transform": )" +
                                 at_half + R"(, "tree": {"set": {"phase": "oil",
            "of": {"translate": {"by": [10, 0, 4], "of": {"box": {"size": [4, 4, 4]}}}}}}}])");
    const TracedGeometry geometry(scene);
    const Transform to_scene = scene.placed.objects.front().first;
    Random random(3);

    SUBCASE("straight on") {
        for (int i = 0; i < 20'000; ++i) {
            CAPTURE(i);
            const glm::dvec3 to = 0.79 * glm::dvec3(direction(random)) * static_cast<double>(uniform(random, 0, 1));
            const glm::vec3 d = direction(random);
            const glm::vec3 from = glm::vec3(to_scene(to)) - 3.0f * d;
            const glm::dvec3 local = to_scene.inverse()(from);
            const glm::dvec3 along = to_scene.inverse().matrix * glm::dvec3(d);
            // How near the line comes to the middle of the drop, and whether it avoids the blocks.
            if (glm::length(local - along * glm::dot(local, along)) > 0.799) continue;
            std::string met;
            for (const Step& step : straight_through(geometry, from, d)) {
                if (step.t > 5) break;
                met += scene.phases[step.to] + " ";
            }
            if (met.ends_with("oil ") || std::abs(local.x) > 3) continue;
            CHECK(met == "glass water glass vacuum ");
        }
        for (int i = 0; i < 20'000; ++i) {
            CAPTURE(i);
            const glm::dvec3 a(5 + 0.9 * static_cast<double>(uniform(random, -1, 1)),
                               0.9 * static_cast<double>(uniform(random, -1, 1)), -3);
            const glm::dvec3 b(5 + 0.9 * static_cast<double>(uniform(random, -1, 1)),
                               0.9 * static_cast<double>(uniform(random, -1, 1)), 5);
            const glm::vec3 from(to_scene(a)), d(glm::normalize(to_scene.matrix * (b - a)));
            std::string met;
            for (const Step& step : straight_through(geometry, from, d)) met += scene.phases[step.to] + " ";
            CHECK(met == "glass oil vacuum ");
        }
    }
    SUBCASE("reflected and refracted at random") {
        int interfaces = 0, touching = 0;
        for (int i = 0; i < 10'000; ++i) {
            glm::vec3 d = direction(random);
            const glm::dvec3 middle = i % 2 == 0 ? glm::dvec3(0) : glm::dvec3(5, 0, 1);
            const glm::vec3 from(to_scene(middle + 0.7 * glm::dvec3(direction(random))));
            const TracedGeometry::Inside start = geometry.inside(from);
            Ray ray{from, d, start.phase, {}, start.in};
            for (int bounce = 0; bounce < 40; ++bounce) {
                PathCounters counters;
                const Hit hit = geometry.intersect(ray, counters);
                const auto* surface = std::get_if<Surface>(&hit);
                if (!surface) break;
                // The ray was in its carried phase all the way.
                if (surface->distance > 1e-3f)
                    REQUIRE(geometry.label(ray.origin + 0.5f * surface->distance * ray.direction) == ray.phase);
                CHECK(surface->near_side.phase == ray.phase);
                CHECK(surface->entered != ray.phase);
                touching += ray.phase != phasetree::vacuum && surface->entered != phasetree::vacuum;
                ++interfaces;
                d = direction(random);
                if (random() % 2 == 0) {
                    if (glm::dot(d, surface->normal) < 0) d = -d;
                    ray = surface->reflected(d);
                } else {
                    if (glm::dot(d, surface->normal) > 0) d = -d;
                    ray = surface->transmitted(d);
                }
            }
        }
        CHECK(interfaces > 20'000);
        CHECK(touching > 8'000);
    }
}

TEST_CASE("where objects overlap, the first is there, and rays end") {
    const Scene scene = scene_of(R"("objects": [
        {"name": "a", "tree": {"set": {"phase": "glass", "of": {"box": {"size": [2, 2, 2]}}}}},
        {"name": "b", "tree": {"set": {"phase": "water", "of": {"box": {"size": [2, 2, 2]}}}},
         "transform": {"translate": {"by": [1, 0, 0]}}}])");
    const TracedGeometry geometry(scene);
    CHECK(scene.phases[geometry.label({0.5f, 0, 0})] == "glass");
    CHECK(scene.phases[geometry.label({1.5f, 0, 0})] == "water");
    for (const float sign : {1.0f, -1.0f}) {
        std::vector<std::string> met;
        for (const Step& s : straight_through(geometry, {0.5f - 5 * sign, 0.1f, 0.2f}, {sign, 0, 0}))
            met.push_back(scene.phases[s.to]);
        const std::vector<std::string> forwards{"glass", "water", "vacuum"}, backwards{"water", "glass", "vacuum"};
        CHECK(met == (sign > 0 ? forwards : backwards));
    }
}

TEST_CASE("of copies at the same place the first is met, also where Embree asks a later one before it") {
    // The box of the second instance, a group, begins nearer to most rays than that of the first, because it also
    // contains beads.
    const Scene scene = scene_of(R"("objects": [
        {"name": "ball", "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}},
        {"name": "bead", "tree": {"set": {"phase": "water", "of": {"sphere": {"radius": 0.01}}}}}],
        "groups": {"more": [{"of": "ball", "transforms": [[0, 0, 0], [0, 0, 0]]},
            {"of": "bead", "transforms": [[-9, -9, -9], [9, 9, 9]]}]},
        "instances": [{"of": "ball"}, {"of": "more"}])");
    const TracedGeometry geometry(scene);
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 d = direction(random), origin = 0.5f * direction(random) - 5.0f * d;
        PathCounters counters;
        const TracedGeometry::Inside start = geometry.inside(origin);
        const Hit hit = geometry.intersect(Ray{origin, d, start.phase, {}, start.in}, counters);
        const auto* surface = std::get_if<Surface>(&hit);
        REQUIRE(surface);
        CHECK(surface->place.copy == 0);
    }
}

TEST_CASE("a ray goes through any number of copies that touch") {
    std::string places;
    for (int i = 0; i < 1500; ++i) places += fmt::format("{}[{}, 0, 0]", i > 0 ? ", " : "", i);
    const Scene scene = scene_of(R"("objects": [
        {"name": "tile", "tree": {"set": {"phase": "glass", "of": {"box": {"size": [1, 1, 1]}}}}}],
        "instances": [{"of": "tile", "transforms": [)" +
                                 places + "]}]");
    const TracedGeometry geometry(scene);
    const std::vector<Step> steps = straight_through(geometry, {-5, 0.1f, 0.2f}, {1, 0, 0});
    REQUIRE(steps.size() == 2);
    CHECK(steps[0].t == doctest::Approx(4.5));
    CHECK(steps[1].t == doctest::Approx(1504.5));
}

TEST_CASE("where objects touch, the one that the ray enters is the one that it meets") {
    Random random(8);
    int touching = 0;
    for (int turn = 0; turn < 40; ++turn) {
        const glm::vec3 axis = direction(random);
        const auto turned = [&](const char* name, const char* phase, float x) {
            return fmt::format(
                R"({{"name": "{}", "tree": {{"set": {{"phase": "{}", "of": {{"box": {{"size": [2, 2, 2]}}}}}}}},
                "transform": [{{"translate": {{"by": [{}, 0, 0]}}}},
                              {{"rotate": {{"axis": [{}, {}, {}], "angle": {}}}}}]}})",
                name, phase, x, axis.x, axis.y, axis.z, 9 * turn);
        };
        const Scene scene =
            scene_of(R"("objects": [)" + turned("a", "glass", -1) + ", " + turned("b", "water", 1) + "]");
        const TracedGeometry geometry(scene);
        for (int i = 0; i < 100; ++i) {
            const glm::vec3 d = direction(random), origin = 0.5f * direction(random) - 6.0f * d;
            Ray ray{origin, d, phasetree::vacuum, {}, {}};
            PathCounters counters;
            while (true) {
                const Hit hit = geometry.intersect(ray, counters);
                const auto* surface = std::get_if<Surface>(&hit);
                if (!surface) break;
                const Phase to = surface->entered.value();
                const std::string shown = scene.phases[to == phasetree::vacuum ? ray.phase : to];
                CHECK(surface->object == (shown == "glass" ? 0u : 1u));
                touching += to != phasetree::vacuum && ray.phase != phasetree::vacuum;
                ray = surface->transmitted(d);
            }
        }
    }
    CHECK(touching > 1000);
}

}  // namespace test_several_objects
