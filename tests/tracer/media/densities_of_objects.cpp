// Media whose density varies, in objects that are placed, copied and moving: each copy carries its density along.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tracer/caustics/photons.hpp"
#include "tracer/support/straight_rays.hpp"

namespace test_densities_of_objects {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A cube of smoke, from z = -0.5, where it is densest, to 0.5, where it ends.
constexpr double extinction = 1.5;
double density(const glm::dvec3& in_object) {
    return std::clamp(0.5 - in_object.z, 0.0, 1.0);
}
const std::string smoke =
    R"("smoke": {"clear": {"ior": 1, "absorption": [1.5, 1.5, 1.5], "density": {"plane": {"offset": 0.5}}, "density_depth": 1}})";
const std::string cube = R"({"set": {"phase": "smoke", "of": {"box": {"size": [1, 1, 1]}}}})";

Scene placed(const std::string& phases, const std::string& objects, const std::string& rest) {
    return read_scene(Document::from_text(R"({"version": 1, "phases": {)" + phases + "}, " + objects + ", " + rest +
                                              R"(, "camera": {"position": [4, -5, 0], "look_at": [4, 0, 0]}})",
                                          "test.json"));
}

// ∫ρ along a line of the scene, in the cube with this placement.
double depth_along(const Transform& to_scene, const glm::dvec3& from, const glm::dvec3& direction, double length) {
    constexpr int steps = 20000;
    const Transform to_object = to_scene.inverse();
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 p = to_object(from + direction * ((i + 0.5) * length / steps));
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 0.5) sum += density(p);
    }
    return sum * length / steps;
}

}  // namespace

TEST_CASE("what is left of light that crosses a copy is by its own place, size and moment") {
    const Scene scene = placed(smoke,
                               R"("objects": [{"name": "cloud", "tree": )" + cube +
                                   R"(, "transform": {"rotate": {"axis": [1, 0, 0], "angle": 90}}},
                       {"name": "drifting", "tree": )" +
                                   cube + R"(, "transform": [{"translate": {"by": [0, 0, 8]}},
                           {"translate": {"by": {"keys": [[0, [0, 0, 0]], [1, [0, 0, 0.5]]]}}}]}],
           "groups": {"pair": [{"of": "cloud"}, {"of": "cloud", "transform": [{"rotate": {"angle": 50}}, {"scale": {"factor": 2}}, {"translate": {"by": [3, 0, 0]}}]}],
                      "pairs": [{"of": "pair"}, {"of": "pair", "transform": [{"stretch": {"factors": [1, 0.5, 1]}}, {"rotate": {"axis": [1, 1, 0], "angle": 200}}, {"translate": {"by": [0, 6, 0]}}]}]},
           "instances": [{"of": "pairs", "transform": {"rotate": {"axis": [0, 1, 0], "angle": 20}}}, {"of": "drifting"}])",
                               R"("lights": [{"constant": {}}], "render": {"shutter": [0, 1]})");
    const World world(scene);
    const FlushSubnormals flush;
    Random random(5);
    std::size_t copies = 0;
    constexpr int rays_each = 3;
    for (const float time : {0.0f, 0.75f})
        scene.placed.each_copy(
            [&](std::uint32_t, const PlacedObject&, const Transform& to_scene) {
                ++copies;
                for (int i = 0; i < rays_each; ++i) {
                    const glm::dvec3 middle = to_scene(glm::dvec3(
                        uniform(random, -0.4f, 0.4f), uniform(random, -0.4f, 0.4f), uniform(random, -0.4f, 0.4f)));
                    const glm::dvec3 along(direction(random));
                    constexpr double half = 4;
                    const glm::vec3 origin(middle - half * along);
                    double depth = 0;
                    scene.placed.each_copy(
                        [&](std::uint32_t, const PlacedObject&, const Transform& any) {
                            depth += depth_along(any, glm::dvec3(origin), along, 30);
                            return true;
                        },
                        static_cast<double>(time));
                    const auto start = world.geometry().inside(origin, time);
                    const Ray ray{origin, glm::vec3(along), start.phase, {}, start.in};
                    Moments found;
                    PathCounters counters;
                    for (std::uint32_t path = 0; path < 4000; ++path) {
                        Sampler sampler(path, 0, 0, 1);
                        found.add(static_cast<double>(trace_path(world, scene, ray, sampler, counters, nullptr, {}).x));
                    }
                    const double expected = std::exp(-extinction * depth);
                    CAPTURE(time);
                    CAPTURE(found.mean());
                    CAPTURE(expected);
                    CHECK(mean_p_value(found, expected, 1e-3) > sidak(1e-4, 10 * rays_each));
                }
                return true;
            },
            static_cast<double>(time));
    CHECK(copies == 10);
}

TEST_CASE("shadow rays cross a copy that is placed in their way") {
    const Scene scene = placed(
        smoke + R"(, "floor": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
        R"("objects": [{"name": "floor", "tree": {"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [20, 20, 1]}}}}}}},
                       {"name": "cloud", "tree": )" +
            cube +
            R"(, "transform": [{"rotate": {"axis": [0, 1, 0], "angle": 150}}, {"translate": {"by": [1, 0, 2]}}]}])",
        R"("lights": [{"point": {"position": [1.2, 0.1, 4], "intensity": 10}}])");
    const World world(scene);
    Transform to_scene;
    scene.placed.each_copy([&](std::uint32_t copy, const PlacedObject&, const Transform& transform) {
        if (copy == 1) to_scene = transform;
        return true;
    });
    const glm::dvec3 at(0.9, 0, 0), way = glm::dvec3(1.2, 0.1, 4) - at;
    const double squared = glm::dot(way, way), distance = std::sqrt(squared);
    const double unhindered = 10 * 0.5 / std::numbers::pi * way.z / (squared * distance);
    const double expected = unhindered * std::exp(-extinction * depth_along(to_scene, at, way / distance, distance));
    const glm::vec3 from(-8, -1, 1);
    const Moments found = radiance_along(world, scene, from, glm::vec3(at) - from, 60000)[0];
    CAPTURE(found.mean() / expected);
    CHECK(expected < 0.6 * unhindered);
    CHECK(mean_p_value(found, expected, 2e-3 * expected) > sidak(1e-4, 2));
    CHECK(mean_p_value(found, 1.02 * expected, 2e-3 * expected) < sidak(1e-4, 2));
}

TEST_CASE("photons bring the light to a copy's medium that paths find there") {
    const Scene scene = placed(
        R"("jelly": {"clear": {"ior": 1.45, "scattering": [4, 4, 4], "absorption": [0.5, 0.5, 0.5], "density": {"plane": {"offset": 1}}, "density_depth": 1.5}})",
        R"("objects": [{"name": "jelly", "tree": {"set": {"phase": "jelly", "of": {"sphere": {"radius": 1}}}},
                        "transform": [{"rotate": {"axis": [1, 0, 0], "angle": 160}}, {"translate": {"by": [4, 0, 0]}}]}])",
        R"("lights": [{"rectangle": {"centre": [4.5, -1, 2.5], "target": [4, 0, 0], "width": 2, "height": 2, "radiance": [4, 4, 4]}}],
           "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": 0.2, "caustics": true})");
    check_against_paths(scene, {4.3f, -3, 0.4f}, {0, 1, 0}, 2 * passes, sidak(1e-4, 2));
}

TEST_CASE("photons cross a copy on their way to a caustic") {
    // About 58 % of the light passes through the cube. If the density were not placed with it, all light would.
    const Scene scene = placed(
        R"("smoke": {"clear": {"ior": 1, "absorption": [6, 6, 6], "density": {"plane": {"offset": -0.2}}, "density_depth": 1}},
           "glass": {"clear": {"ior": 1.5}}, "floor": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
        R"("objects": [{"name": "floor", "tree": {"set": {"phase": "floor", "of": {"translate": {"by": [4, 0, -1.5], "of": {"box": {"size": [8, 8, 1]}}}}}}},
                       {"name": "ball", "tree": {"set": {"phase": "glass", "of": {"translate": {"by": [4, 0, 0], "of": {"sphere": {"radius": 0.6}}}}}}},
                       {"name": "cloud", "tree": )" +
            cube +
            R"(, "transform": [{"scale": {"factor": 2}}, {"rotate": {"axis": [1, 0, 0], "angle": 180}}, {"translate": {"by": [4, 0, 2]}}]}])",
        R"("lights": [{"sphere": {"centre": [4, 0, 5], "radius": 0.5, "radiance": [40, 40, 40]}}],
           "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": 1, "caustics": true})");
    check_against_paths(scene, {4, -2, 0}, {0, 2, -1}, 3 * passes, sidak(1e-4, 2));
}

}  // namespace test_densities_of_objects
