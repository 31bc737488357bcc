// Bumps: normals of known slopes, measured by mirrors and by the light on matt surfaces, on copies and on meshes;
// furnaces; and photons compared with paths.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "phasetree_support/temporary_directory.hpp"
#include "shading/bump.hpp"
#include "tracer/caustics/photons.hpp"
#include "tracer/support/paths.hpp"

namespace test_bump {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A field that is x, and bumps that rise by `height`/2 for each unit of x between −1 and 1.
std::string bump_along_x(double height) {
    return R"("bump": {"field": {"of": {"translate": {"by": [-50, 0, 0], "of": {"box": {"size": [100, 100, 100]}}}},
              "ramp": [[-1, [0, 0, 0]], [1, [1, 1, 1]]]}}, "bump_height": )" +
           std::to_string(height);
}

// A floor of the phase a, with its top at z = 0.
const std::string floor_of_a =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [8, 8, 1]}}}}}})";

constexpr glm::vec3 towards_sun(-0.8f, 0.0f, 0.6f);
const std::string sun =
    R"("lights": [{"sun": {"direction": [-0.8, 0, 0.6], "irradiance": [1, 1, 1], "diameter": 0.01}}])";

// Dark, so that light which a bump scatters into the surface, to be scattered once more, does not matter.
constexpr double albedo = 0.001;
const std::string matt = R"("diffuse": {"color": [0.001, 0.001, 0.001], )";

// The light that such a surface with this normal reflects from that sun.
double in_the_sun(const glm::vec3& normal) {
    return albedo * static_cast<double>(glm::dot(glm::normalize(normal), towards_sun)) / std::numbers::pi;
}

double seen(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction) {
    return radiance_along(World(scene), scene, origin, direction, 16)[0].mean();
}

bool is_near(double found, double expected, double part) {
    return std::abs(found - expected) < part * std::abs(expected);
}

// Checks that the light is as expected, and that it would not be if the height were 1 % larger.
void check_light(double found, double expected, double of_more) {
    CAPTURE(found);
    CAPTURE(expected);
    CHECK(is_near(found, expected, 3e-4));
    CHECK_FALSE(is_near(found, of_more, 3e-4));
}

}  // namespace

TEST_CASE("a bump that rises evenly turns a floor's normal by its slope") {
    const auto floor = [&](double height) {
        return scene_of("\"a\": {" + matt + bump_along_x(height) + "}}", floor_of_a, sun);
    };
    for (const double height : {1.0, -0.5, 0.02}) {
        CAPTURE(height);
        const auto normal = [&](double h) { return glm::vec3(static_cast<float>(-h / 2), 0.0f, 1.0f); };
        const double found = seen(floor(height), {0.1f, -0.3f, 2}, {0, 0.1f, -1});
        if (height != 0.02) return check_light(found, in_the_sun(normal(height)), in_the_sun(normal(1.01 * height)));
        check_light(found, in_the_sun(normal(height)), in_the_sun(normal(0)));
    }
    // A mirror shows the sky where its slope turns the ray to.
    const Scene mirror = scene_of(
        R"("a": {"conductor": {"eta": [1, 1, 1], "k": [100000, 100000, 100000], )" + bump_along_x(0.5) + "}}",
        floor_of_a, R"("lights": [{"gradient": {"zenith": [9, 9, 9], "horizon": [0, 0, 0], "ground": [0, 0, 0]}}])");
    const glm::vec3 direction = glm::normalize(glm::vec3(0.6f, 0.0f, -1.0f));
    const auto sky = [&](float height) {
        const glm::vec3 n = glm::normalize(glm::vec3(-height / 2, 0.0f, 1.0f));
        const auto light = mirror.lights.seen({0, 0, 0}, glm::reflect(direction, n), INFINITY, false);
        return static_cast<double>(light->radiance.x);
    };
    check_light(seen(mirror, -2.0f * direction, direction), sky(0.5f), sky(0.505f));
}

TEST_CASE("a bump turns with the copy of its object, and keeps its slope where that is larger") {
    // Turned by 90° about z, x of the object is y of the scene.
    const std::string object = R"({"name": "floor", "tree": )" + floor_of_a + R"(, "transform":
        [{"rotate": {"angle": 90}}, {"scale": {"factor": 3}}]})";
    const Scene scene = read_scene(phasetree::Document::from_text(
        R"({"version": 1, "phases": {"a": {)" + matt + bump_along_x(1) + R"(}}}, "objects": [)" + object +
            R"(], "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, )" + sun + "}",
        "test.json"));
    const double found = seen(scene, {0.1f, -0.3f, 2}, {0, 0.1f, -1});
    check_light(found, in_the_sun({0, -0.5f, 1}), in_the_sun({0, 0.5f / 3, 1}));
}

TEST_CASE("an image on a mesh bumps it by the mesh's coordinates") {
    // 64 grey columns of brightness u, on a square of 4 by 4 whose u is along y.
    const phasetree::support::TemporaryDirectory directory;
    std::ofstream image(directory.path() / "ramp.ppm");
    image << "P3 64 1 255\n";
    for (int i = 0; i < 64; ++i)
        for (int c = 0; c < 3; ++c) image << 4 * i << ' ';
    image.close();
    std::ofstream(directory.path() / "square.obj")
        << "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\nf 1/1 2/2 3/3 4/4\n";
    std::ofstream(directory.path() / "scene.json")
        << R"({"version": 1, "phases": {"a": {"diffuse": {"color": [0, 0, 0]}}},
            "tree": {"set": {"phase": "a", "of": {"translate": {"by": [0, 0, -9], "of": {"sphere": {"radius": 1}}}}}},
            "meshes": [{"obj": {"file": "square.obj", "material": {"diffuse": {"color": [0.001, 0.001, 0.001],
                "bump": {"mesh_image": {"file": "ramp.ppm"}}, "bump_height": 1}}}}],
            "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, )"
        << sun << "}";
    const Scene scene = read_scene(phasetree::Document::from_file(directory.path() / "scene.json"));
    // The file's numbers are sRGB, so the slope follows from the decoded values, as differences over the height of 1.
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    const auto brightness = [&](double y) { return linear(((y + 2) / 4 * 64 - 0.5) * 4 / 255); };
    const double slope = brightness(0.8) - brightness(-0.2);
    const double found = seen(scene, {0.1f, 0.3f, 2}, {0, 0, -1});
    const auto expected = [&](double by) { return in_the_sun({0, static_cast<float>(-by * slope), 1}); };
    CHECK(is_near(found, expected(1), 2e-3));
    CHECK_FALSE(is_near(found, expected(1.1), 2e-3));
}

TEST_CASE("bumps neither take nor give light: furnaces of all materials, at all angles") {
    const std::string rough = R"("bump": {"speckle": {"color": [1, 1, 1], "other": [0, 0, 0], "grain": 0.12,
                                 "contrast": 1}}, "bump_height": 0.1)";
    const std::string white_metal = R"("conductor": {"eta": [1, 1, 1], "k": [100000, 100000, 100000], )";
    const std::vector<std::string> materials{R"("diffuse": {"color": [1, 1, 1], )",
                                             R"("diffuse": {"color": [1, 1, 1], "roughness": 1, )",
                                             white_metal,
                                             white_metal + R"("roughness": 0.4, )",
                                             R"("coated": {"color": [1, 1, 1], )",
                                             R"("coated": {"color": [1, 1, 1], "roughness": 0.3, )"};
    const double significance = sidak(1e-4, 4 * materials.size());
    for (const std::string& material : materials) {
        CAPTURE(material);
        Scene scene = scene_of("\"a\": {" + material + rough + "}}",
                               R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})");
        scene.settings.max_depth = 1000;
        const World world(scene);
        for (const float height : {0.0f, 0.6f, 0.95f, 0.995f}) {
            CAPTURE(height);
            const Moments found = radiance_along(world, scene, {0.01f, -5, height}, {0, 1, 0}, 40000)[0];
            CHECK(mean_p_value(found, 1.0, 1e-3) > significance);
            CHECK(mean_p_value(found, 1.02, 1e-3) < significance);
        }
    }
}

TEST_CASE("photons and paths find the same light on bumps") {
    check_pictures(
        [&](bool caustics) {
            Scene scene = scene_of(
                R"("a": {"clear": {"ior": 1.5}}, "b": {"diffuse": {"color": [0.7, 0.7, 0.7],
                   )" +
                    bump_along_x(2) + "}}",
                R"({"over": [{"set": {"phase": "b", "of": {"translate": {"by": [0, 0, -1.7], "of": {"box": {"size": [6, 6, 1]}}}}}},
                             {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}]})",
                R"("lights": [{"sphere": {"centre": [-1.6, 0, 3], "radius": 0.4, "radiance": [20, 20, 20]}}],
                   "camera": {"position": [0, -5, 3], "look_at": [0, 0, -1], "fov": 45},
                   "render": {"width": 40, "height": 32})");
            scene.settings.samples = long_form ? 256 : 40;
            scene.settings.caustics = caustics;
            return scene;
        },
        long_form ? 1.05 : 1.13, sidak(1e-4, 2));
}

}  // namespace test_bump
