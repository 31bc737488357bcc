// Bumps on clear materials: normals of known slopes and refraction by them, from both sides; furnaces; pictures through
// glass with bumps, against glass that is really displaced; and photons and shadow rays, against paths.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tracer/caustics/photons.hpp"
#include "world/chain.hpp"

namespace test_clear_bumps {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// Bumps whose brightness rises by 1/2 for each unit of x or y between −1 and 1.
std::string bump_along(char axis, double height) {
    return fmt::format(
        R"("bump": {{"field": {{"of": {{"translate": {{"by": {}, "of": {{"box": {{"size": [200, 200, 200]}}}}}}}},
           "ramp": [[-1, [0, 0, 0]], [1, [1, 1, 1]]]}}}}, "bump_height": {})",
        axis == 'x' ? "[-100, 0, 0]" : "[0, -100, 0]", height);
}

// A box that fills z from `low` to `high`.
std::string layer(const std::string& phase, double low, double high) {
    return fmt::format(
        R"({{"set": {{"phase": "{}", "of": {{"translate": {{"by": [0, 0, {}], "of": {{"box": {{"size": [40, 40, {}]}}}}}}}}}}}})",
        phase, (low + high) / 2, high - low);
}

bool is_near(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-4f;
}

// The direction of a ray refracted by Snell's law; `n` faces the ray.
glm::vec3 refracted(const glm::vec3& d, const glm::vec3& n, float eta) {
    return glm::refract(d, n, 1 / eta);
}

// Bumps by noise that are up to 4 cm high and half a metre wide.
constexpr double amplitude = 0.04, width = 0.5;
const std::string waves =
    fmt::format(R"({{"displace": {{"amplitude": {}, "scale": {}, "of": {{"plane": {{}}}}}}}})", amplitude, width);
// The brightness of −λ times this field, which is a n/λ on the plane and is not clamped between ±a/λ, is the height −a
// n of the displaced plane, where n is the noise.
const double stretch = 1 + amplitude * 15 / (4 * width);
const std::string wave_bump =
    fmt::format(R"("bump": {{"field": {{"of": {}, "ramp": [[{}, [1, 1, 1]], [{}, [0, 0, 0]]]}}}}, "bump_height": {})",
                waves, -amplitude / stretch, amplitude / stretch, 2 * amplitude);

}  // namespace

TEST_CASE("a bump that rises evenly turns the normals of a clear phase by its slope, seen from both sides") {
    for (const double height : {1.0, -0.4}) {
        const auto slope = static_cast<float>(height / 2);
        const World world(
            scene_of(R"("a": {"clear": {"ior": 1.5, )" + bump_along('x', height) + "}}", layer("a", -20, 0)));
        const auto above = surface_met(world, {0.1f, -0.3f, 2}, {0, 0.1f, -1});
        const auto below = surface_met(world, {0.1f, -0.3f, -2}, {0, 0.1f, 1});
        REQUIRE(above.has_value());
        REQUIRE(below.has_value());
        CHECK(is_near(above->normal, glm::normalize(glm::vec3(-slope, 0, 1))));
        CHECK(is_near(below->normal, glm::normalize(glm::vec3(slope, 0, -1))));
        CHECK(is_near(above->geometric_normal, {0, 0, 1}));
        // A ray that is refracted there goes where Snell's law says.
        for (const auto& [surface, d, eta] : {std::tuple(*above, glm::normalize(glm::vec3(0, 0.1f, -1)), 1.5f),
                                              {*below, glm::vec3(0, 0.0995037f, 0.9950372f), 1 / 1.5f}}) {
            const Bsdf bsdf = surface.bsdf();
            const Frame frame = surface.frame();
            const auto next = bsdf.sample(frame.to_local(-d), 0x1.fffffep-1f, {});
            REQUIRE(next.has_value());
            REQUIRE(next->transmitted);
            CHECK(is_near(continued(surface, frame, *next).direction, refracted(d, surface.normal, eta)));
        }
    }
}

TEST_CASE("where two clear materials meet, the higher bump is used, raised out of the material that has it") {
    // Raised by h along y out of b, which is above, the interface is −h y/2 high.
    const auto normal_between = [&](double of_a, double of_b, float from) {
        const World world(scene_of(R"("a": {"clear": {"ior": 1.5, )" + bump_along('x', of_a) +
                                       R"(}}, "b": {"clear": {"ior": 1.3, )" + bump_along('y', of_b) + "}}",
                                   R"({"over": [)" + layer("a", -20, 0) + ", " + layer("b", 0, 20) + "]}"));
        const auto surface = surface_met(world, {0.1f, -0.3f, from}, {0, 0.1f, -from});
        REQUIRE(surface.has_value());
        return surface->normal;
    };
    const glm::vec3 by_a = glm::normalize(glm::vec3(-0.5f, 0, 1)), by_b = glm::normalize(glm::vec3(0, 0.75f, 1));
    CHECK(is_near(normal_between(1, 0.5, 2), by_a));
    CHECK(is_near(normal_between(1, -0.5, -2), -by_a));
    CHECK(is_near(normal_between(1, 1.5, 2), by_b));
    CHECK(is_near(normal_between(-1, 1.5, -2), -by_b));
}

TEST_CASE("bumps on glass neither take nor give light: furnaces at all angles") {
    const std::string speckle = R"("bump": {"speckle": {"color": [1, 1, 1], "other": [0, 0, 0], "grain": 0.12,
                                 "contrast": 1}}, "bump_height": 0.1)";
    const double significance = sidak(1e-4, 12);
    // Rough glass is noisy.
    for (const auto& [parameters, factor] :
         {std::pair("", 1.02), {R"("roughness": 0.1, )", 1.05}, {R"("film_thickness": 300, )", 1.02}}) {
        const std::string more = parameters;
        CAPTURE(more);
        Scene scene = scene_of(R"("a": {"clear": {"ior": 1.5, )" + more + speckle + "}}",
                               R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})");
        scene.settings.max_depth = 1000;
        const World world(scene);
        for (const float height : {0.0f, 0.6f, 0.95f, 0.995f}) {
            CAPTURE(height);
            const Moments found = radiance_along(world, scene, {0.01f, -5, height}, {0, 1, 0}, samples_of(40000))[0];
            CHECK(mean_p_value(found, 1.0, 1e-3) > significance);
            CHECK(mean_p_value(found, detected(factor), 1e-3) < significance);
        }
    }
}

TEST_CASE("light that bumps send back to the surface is found exactly once") {
    // A white ball in a ball of glass. Shadow rays from the white ball meet slopes of 1.5 in the glass.
    Scene scene = scene_of(
        R"("white": {"diffuse": {"color": [1, 1, 1]}}, "a": {"clear": {"ior": 1.5, )" + bump_along('x', 3) + "}}",
        R"({"over": [{"set": {"phase": "white", "of": {"sphere": {"radius": 0.6}}}},
                                        {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}]})");
    scene.settings.max_depth = 10000;
    const double significance = sidak(1e-4, 6);
    for (const Techniques techniques : {Techniques::all, Techniques::directions_alone}) {
        scene.settings.techniques = techniques;
        const World world(scene);
        for (const float height : {0.0f, 0.4f, 0.9f}) {
            CAPTURE(height);
            const Moments found = radiance_along(world, scene, {0.01f, -5, height}, {0, 1, 0}, samples_of(80000))[0];
            CHECK(mean_p_value(found, 1.0, 1e-3) > significance);
            CHECK(mean_p_value(found, detected(1.03), 1e-3) < significance);
        }
    }
}

TEST_CASE("glass with low bumps looks like glass that is displaced by them") {
    // A pane over a chequered floor, under a sky that is brighter on one side.
    const auto picture = [&](const std::string& top, const std::string& bump) {
        const Scene scene = scene_of(
            R"("floor": {"diffuse": {"color": {"checker": {"size": 0.3, "even": [0.9, 0.9, 0.9], "odd": [0.1, 0.1, 0.1]}}}},
               "glass": {"clear": {"ior": 1.5)" +
                bump + "}}",
            R"({"over": [)" + layer("floor", -3, -2) + R"(, {"set": {"phase": "glass", "of": {"intersection": [)" +
                top + R"(, {"box": {"size": [30, 30, 1]}}]}}}]})",
            R"("lights": [{"gradient": {"zenith": [1, 1, 1], "horizon": [3, 3, 3], "ground": [0, 0, 0]}}],
               "camera": {"orthographic": {"position": [1, -3, 5], "look_at": [0, 0, 0], "height": 3, "filter": "box"}},
               "render": {"width": 40, "height": 40, "samples": 100})");
        return image_of(World(scene), scene);
    };
    const auto difference = [](const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            sum += std::pow(static_cast<double>(a.pixels[i].x - b.pixels[i].x), 2);
        return std::sqrt(sum / static_cast<double>(a.pixels.size()));
    };
    const std::string plane = R"({"plane": {}})";
    const Image displaced = picture(waves, ""), bumped = picture(plane, ", " + wave_bump), flat = picture(plane, "");
    std::string half = wave_bump;
    half.replace(half.rfind(": "), std::string::npos, fmt::format(": {}", amplitude));
    CAPTURE(difference(flat, displaced));
    CAPTURE(difference(bumped, displaced));
    CHECK(difference(bumped, displaced) < 0.25 * difference(flat, displaced));
    // Bumps half as high would be detected.
    CHECK(difference(picture(plane, ", " + half), displaced) > 0.35 * difference(flat, displaced));
}

TEST_CASE("photons, shadow rays and paths find the same light through glass with bumps") {
    const auto scene_with = [](const std::string& glass) {
        return scene_of(
            R"("floor": {"diffuse": {"color": [0.6, 0.6, 0.6]}}, "glass": {"clear": {"ior": 1.5, )" + glass + "}}",
            R"({"over": [)" + layer("floor", -1, -0.6) +
                R"(, {"set": {"phase": "glass", "of": {"intersection": [{"plane": {}},
                            {"translate": {"by": [0, 0, -0.1], "of": {"box": {"size": [3, 3, 0.5]}}}}]}}}]})",
            R"("lights": [{"sphere": {"centre": [-1, 0.5, 2], "radius": 0.4, "radiance": [20, 20, 20]}},
                                   {"sphere": {"centre": [2.5, -0.5, 0.8], "radius": 0.3, "radiance": [15, 15, 15]}}],
                       "camera": {"position": [0, -0.1, 5], "look_at": [0, 0, 0], "fov": 20},
                       "render": {"width": 24, "height": 24})");
    };
    const std::vector<std::string> cases{R"("roughness": 0.2, )" + wave_bump, wave_bump};
    for (const std::string& glass : cases) {
        CAPTURE(glass);
        const auto with = [&](bool caustics) {
            Scene scene = scene_with(glass);
            scene.settings.caustics = caustics;
            scene.settings.samples = long_form ? 500 : 10;
            scene.settings.photons = long_form ? 16 : 6;
            scene.settings.photon_radius = 0.3f;
            return scene;
        };
        check_pictures(with, planted, sidak(1e-4, 4 * cases.size()));
        const auto by_techniques = [&](bool all) {
            Scene scene = with(false);
            scene.settings.techniques = all ? Techniques::all : Techniques::directions_alone;
            return scene;
        };
        check_pictures(by_techniques, planted, sidak(1e-4, 4 * cases.size()));
    }
}

}  // namespace test_clear_bumps
