// Light sampling and BSDF sampling, weighted together, against a closed form: a diffuse floor under a rectangle and an
// environment, which the rectangle hides in part.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tracer/support/paths.hpp"

namespace test_mis {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

constexpr double half_turn = std::numbers::pi;

// Lambert's formula for the irradiance at the origin, normal +z, of a polygon of radiance 1 above the horizon:
// E = ½ Σ angle(vᵢ, vᵢ₊₁) n·(vᵢ × vᵢ₊₁)/|vᵢ × vᵢ₊₁|.
double irradiance(const std::array<glm::dvec3, 4>& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % 4]);
        const glm::dvec3 axis = glm::cross(a, b);
        sum += std::atan2(glm::length(axis), glm::dot(a, b)) * axis.z / glm::length(axis);
    }
    return std::abs(sum) / 2;
}

}  // namespace

TEST_CASE("a diffuse floor under a rectangle and an environment") {
    struct Case {
        std::string name;
        double height;  // of a rectangle of 1.2 by 0.8
        bool mesh;      // the floor is a mesh, or a phase of the object
    };
    const Case cases[] = {{"mesh, far", 2, true},
                          {"mesh, near: most BSDF samples meet the light", 0.15, true},
                          {"phase, far", 2, false},
                          {"phase, near", 0.15, false}};
    const double significance = sidak(1e-4, std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const std::string z = std::to_string(c.height);
        const auto test = [&](const char* radiance) {
            const std::string lights =
                R"("lights": [{"constant": {"radiance": [0.1, 0.1, 0.1]}}, {"rectangle": {"centre": [0.3, 0.2, )" + z +
                R"(], "target": [0.3, 0.2, 0], "width": 1.2, "height": 0.8, "radiance": )" + radiance + "}}]";
            const std::string phases = R"("paint": {"diffuse": {"color": [0.6, 0.6, 0.6]}})";
            const std::string slab = R"({"set": {"phase": "paint", "of": {"translate": {"by": [0, 0, )" +
                                     std::string(c.mesh ? "-3" : "-1") +
                                     R"(], "of": {"box": {"size": [10, 10, 2]}}}}}})";
            const std::string mesh =
                R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], )";
            const Scene scene = scene_of(phases, slab, (c.mesh ? mesh : "") + lights);
            const World world(scene);
            // Seen from the side, below the rectangle.
            const glm::vec3 from(-2, -1.5f, 0.1f);
            const Moments m = radiance_along(world, scene, from, -from, 60000)[0];
            const double e = irradiance({glm::dvec3(-0.3, -0.2, c.height), glm::dvec3(0.9, -0.2, c.height),
                                         glm::dvec3(0.9, 0.6, c.height), glm::dvec3(-0.3, 0.6, c.height)});
            const double expected = 0.6 / half_turn * (40 * e + 0.1 * (half_turn - e));
            CAPTURE(m.mean());
            CAPTURE(expected);
            CHECK(std::abs(m.mean() / expected - 1) < 0.02);
            return mean_p_value(m, expected, 5e-5 * expected);
        };
        CHECK(test("[40, 40, 40]") > significance);
        CHECK(test("[40.4, 40.4, 40.4]") < significance);
    }
}

TEST_CASE("what is before a lamp shades the floor, however near to the lamp; what is behind the lamp does not") {
    for (const float height : {0.3f, 1.0f, 1.9f, 2.1f, 3.0f}) {
        CAPTURE(height);
        const std::string plate = R"({"set": {"phase": "black", "of": {"translate": {"by": [0.3, 0.2, )" +
                                  std::to_string(height) + R"(], "of": {"box": {"size": [12, 12, 0.02]}}}}}})";
        const Scene scene = scene_of(R"("black": {"diffuse": {"color": [0, 0, 0]}})", plate,
                                     R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}],
            "lights": [{"rectangle": {"centre": [0.3, 0.2, 2], "target": [0.3, 0.2, 0], "width": 1.2, "height": 0.8,
                                      "radiance": [40, 40, 40]}}])");
        const World world(scene);
        const Moments m = radiance_along(world, scene, {-2, -1.5f, 0.1f}, {2, 1.5f, -0.1f}, 20000)[0];
        const double e = irradiance(
            {glm::dvec3(-0.3, -0.2, 2), glm::dvec3(0.9, -0.2, 2), glm::dvec3(0.9, 0.6, 2), glm::dvec3(-0.3, 0.6, 2)});
        const double lit = 0.6 / half_turn * 40 * e;
        if (height < 2)
            CHECK(m.mean() == 0);
        else
            CHECK(mean_p_value(m, lit, 5e-5 * lit) > 1e-4);
    }
}

TEST_CASE("light that comes to the floor by way of a mirror is found once") {
    // A wall of metal that absorbs almost nothing mirrors everything in front of it: half of what the floor sees.
    const std::string phases = R"("metal": {"conductor": {"eta": [1e-6, 1e-6, 1e-6], "k": [5, 5, 5]}})";
    const std::string wall = R"({"set": {"phase": "metal", "of": {"translate": {"by": [-2, 0, 0], "of": {"box": {
        "size": [2, 12, 12]}}}}}})";
    const auto p_value = [&](const char* environment) {
        const Scene scene =
            scene_of(phases, wall,
                     std::string(R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], )") +
                         R"("lights": [{"constant": {"radiance": )" + environment + "}}]");
        const World world(scene);
        return mean_p_value(radiance_along(world, scene, {2, -1.5f, 0.1f}, {-2.8f, 1.5f, -0.1f}, 60000)[0], 0.6, 1e-5);
    };
    CHECK(p_value("[1, 1, 1]") > 1e-4);
    CHECK(p_value("[1.01, 1.01, 1.01]") < 1e-4);
}

TEST_CASE("lights that the camera does not see light the scene all the same; a background does not") {
    const std::string phases = R"("paint": {"diffuse": {"color": [1, 1, 1]}})";
    const std::string ball = R"({"set": {"phase": "paint", "of": {"sphere": {"radius": 1}}}})";
    const Scene scene = scene_of(phases, ball, std::string(white_environment) + R"(, "background": [0, 0, 0])");
    const World world(scene);
    CHECK(radiance_along(world, scene, {0, -5, 0}, {1, 0, 0}, 10)[0].mean() == 0);
    CHECK(mean_p_value(radiance_along(world, scene, {0, -5, 0}, {0, 1, 0}, 20000)[0], 1, 1e-5) > 1e-4);
}

}  // namespace test_mis
