// The grain of brushed metal: the direction of its strokes on the tree, on copies and on meshes, and the light that
// they reflect.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tracer/support/paths.hpp"

namespace test_grain {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

std::string brushed(const std::string& grain) {
    return R"("conductor": {"eta": [1, 1, 1], "k": [100000, 100000, 100000], "roughness": 0.1, )" + grain + "}";
}

const std::string floor_of_a =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [8, 8, 1]}}}}}})";

// The direction of the strokes where a ray meets a surface.
glm::vec3 strokes(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction) {
    const World world(scene);
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    const Hit hit = world.geometry().intersect(ray, counters);
    const Surface* surface = std::get_if<Surface>(&hit);
    REQUIRE(surface);
    REQUIRE(surface->along_grain);
    const glm::vec3 along = surface->frame().to_world({1, 0, 0});
    CHECK(std::abs(glm::dot(along, surface->normal)) < 1e-6f);
    return along;
}

// Strokes have no sign, so opposite directions count as parallel.
bool are_parallel(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(glm::cross(a, glm::normalize(b))) < 1e-4f;
}

}  // namespace

TEST_CASE("a frame along a direction is orthonormal even if the direction is almost the normal") {
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    const Frame any(normal);
    for (const float sine : {1.0f, 1e-2f, 1e-3f, 1.2e-4f, 1e-5f, 0.0f}) {
        for (const float length : {1e-12f, 1.0f, 1e12f}) {
            const Frame frame(normal, length * (normal + sine * any.to_world({0.6f, 0.8f, 0})));
            const glm::vec3 x = frame.to_world({1, 0, 0}), y = frame.to_world({0, 1, 0});
            CAPTURE(sine);
            CAPTURE(length);
            CHECK(std::abs(glm::length(x) - 1) < 1e-6f);
            CHECK(std::abs(glm::length(y) - 1) < 1e-6f);
            CHECK(std::abs(glm::dot(x, normal)) < 1e-6f);
            CHECK(std::abs(glm::dot(x, y)) < 1e-6f);
            if (sine > 1e-4f) CHECK(glm::dot(x, any.to_world({0.6f, 0.8f, 0})) > 1 - 2e-6f / sine);
        }
    }
}

TEST_CASE("strokes run along a direction as it lies on the surface") {
    const std::string ball = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";
    const Scene scene = scene_of("\"a\": {" + brushed(R"("grain_along": [0, 2, 1])") + "}", ball);
    CHECK(are_parallel(strokes(scene, {0, 0, 3}, {0, 0, -1}), {0, 1, 0}));
    CHECK(are_parallel(strokes(scene, {3, 0, 0}, {-1, 0, 0}), {0, 2, 1}));
    // At the normal (0, 0.6, 0.8) the projection of (0, 2, 1) is along (0, 0.8, −0.6).
    CHECK(are_parallel(strokes(scene, {0, 1.2f, 1.6f}, {0, -0.6f, -0.8f}), {0, 0.8f, -0.6f}));
    // Where the surface is perpendicular to the strokes, they have no direction, and an arbitrary one is used.
    const glm::vec3 there = glm::normalize(glm::vec3(0, 2, 1));
    CHECK(std::isfinite(strokes(scene, 3.0f * there, -there).x));
}

TEST_CASE("strokes run around an axis, wherever it is") {
    const auto scene = [](const std::string& grain) { return scene_of("\"a\": {" + brushed(grain) + "}", floor_of_a); };
    const Scene origin = scene(R"("grain_around": [0, 0, 3])");
    CHECK(are_parallel(strokes(origin, {1, 2, 3}, {0, 0, -1}), {-2, 1, 0}));
    const Scene moved = scene(R"("grain_around": [0, 0, -1], "grain_through": [1, 1, 7])");
    CHECK(are_parallel(strokes(moved, {1, 2, 3}, {0, 0, -1}), {1, 0, 0}));
    CHECK(std::isfinite(strokes(moved, {1, 1, 3}, {0, 0, -1}).x));
}

TEST_CASE("strokes turn with the copy of their object") {
    const std::string object = R"({"name": "floor", "tree": )" + floor_of_a + R"(, "transform":
        [{"rotate": {"angle": 90}}, {"scale": {"factor": 2}}, {"translate": {"by": [0.5, 0, 0]}}]})";
    const auto scene = [&](const std::string& grain) {
        return read_scene(phasetree::Document::from_text(
            R"({"version": 1, "phases": {"a": {)" + brushed(grain) + R"(}}, "objects": [)" + object +
                R"(], "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, )" + white_environment + "}",
            "test.json"));
    };
    // x of the object is y of the scene.
    CHECK(are_parallel(strokes(scene(R"("grain_along": [3, 1, 0])"), {0.1f, 0.2f, 3}, {0, 0, -1}), {-1, 3, 0}));
    const Scene around = scene(R"("grain_around": [0, 0, 1], "grain_through": [1, 0, 0])");
    // The transform takes the axis through (1, 0) to (0.5, 2).
    CHECK(are_parallel(strokes(around, {1.5f, 2, 3}, {0, 0, -1}), {0, 1, 0}));
    CHECK(are_parallel(strokes(around, {0.5f, 1, 3}, {0, 0, -1}), {1, 0, 0}));
    CHECK(std::isfinite(strokes(around, {0.5f, 2, 3}, {0, 0, -1}).x));
}

TEST_CASE("strokes of a stretched copy lie as they do in its object, stretched") {
    const std::string object =
        R"({"name": "floor", "tree": )" + floor_of_a + R"(, "transform": {"stretch": {"factors": [1, 3, 1]}}})";
    const Scene scene = read_scene(phasetree::Document::from_text(
        R"({"version": 1, "phases": {"a": {)" + brushed(R"("grain_along": [1, 1, 0])") + R"(}}, "objects": [)" +
            object + R"(], "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, )" + white_environment + "}",
        "test.json"));
    CHECK(are_parallel(strokes(scene, {0.1f, 0.2f, 3}, {0, 0, -1}), {1, 3, 0}));
}

TEST_CASE("strokes run over meshes") {
    const std::string meshes = R"("meshes": [{"floor": {"height": 0, "material": {)" +
                               brushed(R"("grain_along": [1, 1, 1])") + R"(}}}], )" + white_environment;
    const Scene scene = scene_of(
        R"("a": {"diffuse": {"color": [0, 0, 0]}})",
        R"({"set": {"phase": "a", "of": {"translate": {"by": [0, 0, 9], "of": {"sphere": {"radius": 1}}}}}})", meshes);
    CHECK(are_parallel(strokes(scene, {0.3f, 0.2f, 3}, {0.1f, 0, -1}), {1, 1, 0}));
}

TEST_CASE("a small sun in brushed metal is as bright as its microfacets make it, along the strokes and across") {
    // Slopes of Student's distribution, each over its own roughness, and masking of both directions (Heitz 2014). Light
    // that is scattered more than once is less than a thousandth here.
    const auto expected = [](const glm::dvec3& wo, const glm::dvec3& wi, double a, double b) {
        const glm::dvec3 h = glm::normalize(wo + wi);
        const double x = h.x / h.z / a, y = h.y / h.z / b;
        const double slopes = 1 / (std::numbers::pi * a * b * (1 + x * x + y * y) * (1 + x * x + y * y));
        const auto lambda = [&](const glm::dvec3& w) {
            return (std::sqrt(1 + (a * a * w.x * w.x + b * b * w.y * w.y) / (w.z * w.z)) - 1) / 2;
        };
        return slopes / (h.z * h.z * h.z * h.z) / (1 + lambda(wo) + lambda(wi)) / (4 * wo.z);
    };
    const glm::vec3 towards_sun = glm::normalize(glm::vec3(0.3f, 0.2f, 1));
    const Scene scene =
        scene_of("\"a\": {" + brushed(R"("grain_along": [0, 1, 0], "grain_aspect": 0.4)") + "}", floor_of_a,
                 R"("lights": [{"sun": {"direction": [0.3, 0.2, 1], "irradiance": [1, 1, 1], "diameter": 0.001}}])");
    const World world(scene);
    const glm::vec3 mirrored(-towards_sun.x, -towards_sun.y, towards_sun.z);
    for (const glm::vec2 aside : {glm::vec2(0, 0), glm::vec2(0.12f, 0), glm::vec2(0, 0.12f), glm::vec2(0.1f, -0.1f)}) {
        CAPTURE(aside.x);
        CAPTURE(aside.y);
        const glm::vec3 wo = glm::normalize(mirrored + glm::vec3(aside, 0));
        const double found = radiance_along(world, scene, 3.0f * wo, -wo, 4)[0].mean();
        // Their local x is y of the scene. The sun's irradiance is given perpendicular to its rays. On the floor it is
        // smaller by a cosine, which f |cos θi| already contains.
        const auto local = [](const glm::vec3& w) { return glm::dvec3(w.y, -w.x, w.z); };
        const auto is_near = [&](double value) { return std::abs(found / value - 1) < 3e-3; };
        CAPTURE(found);
        CHECK(is_near(expected(local(wo), local(towards_sun), 0.04, 0.1)));
        CHECK_FALSE(is_near(expected(local(wo), local(towards_sun), 0.0404, 0.1)));
    }
}

TEST_CASE("contradictory settings of a grain are told") {
    const auto message = [](const std::string& members) -> std::string {
        try {
            (void)scene_of(R"("a": {"conductor": {"metal": "iron", )" + members + "}}", floor_of_a);
        } catch (const phasetree::SceneError& error) {
            return error.what();
        }
        return "";
    };
    const std::string along = R"("grain_along": [1, 0, 0])", around = R"("grain_around": [1, 0, 0])";
    const std::string rough = R"("roughness": 0.2, )";
    CHECK(message(rough + along) == "");
    CHECK(message(rough + along + ", " + around).find("\"grain_along\" and \"grain_around\" cannot be combined") !=
          std::string::npos);
    CHECK(message(along).find("give it a \"roughness\"") != std::string::npos);
    CHECK(message(rough + R"("grain_aspect": 0.5)").find("requires \"grain_along\"") != std::string::npos);
    CHECK(message(rough + along + R"(, "grain_through": [0, 0, 0])").find("requires \"grain_around\"") !=
          std::string::npos);
    CHECK(message(rough + R"("grain_along": [0, 0, 0])").find("must not be zero") != std::string::npos);
}

}  // namespace test_grain
