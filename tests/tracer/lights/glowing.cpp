// Phases and meshes that emit light: closed forms, a furnace whose walls glow, and shadow rays compared with the paths'
// own directions.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "phasetree_support/temporary_directory.hpp"
#include "sampling/warps.hpp"
#include "support/long_tests.hpp"
#include "support/uniform.hpp"
#include "tracer/support/glowing_scenes.hpp"
#include "tracer/support/paths.hpp"

namespace test_glowing {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::normal_two_sided;
using phasetree::tests::Uniform;

namespace {

constexpr Techniques each_technique[] = {Techniques::all, Techniques::shadow_rays_alone, Techniques::directions_alone};

const std::string floor_of =
    R"("meshes": [{"floor": {"size": 40, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}])";

void check_radiance(const World& world, const Scene& scene, const glm::vec3& origin, const glm::vec3& direction,
                    std::uint32_t count, double expected, double significance, double planted = 0.01) {
    const auto m = radiance_along(world, scene, origin, direction, count);
    CAPTURE(m[0].mean() / expected);
    CAPTURE(m[0].standard_error() / expected);
    CHECK(mean_p_value(m[0], expected, 0) > significance);
    CHECK(mean_p_value(m[0], detected(1 + planted) * expected, 0) < significance);
    // The light has its colour.
    CHECK(m[1].mean() == doctest::Approx(0.5 * m[0].mean()).epsilon(1e-4));
    CHECK(m[2].mean() == doctest::Approx(0.25 * m[0].mean()).epsilon(1e-4));
}

const std::string torus = R"({"torus": {"major": 0.5, "minor": 0.1}})";
const std::string flame = R"("ior": 1, "emission": [16, 8, 4], "absorption": [0.5, 1, 2])";

// Shadow rays are compared with directions along this ray, which meets the floor. The significance is that of one in
// thirteen comparisons.
const glm::vec3 along_origin(-2, -2, 0.1f), along_direction(1.9f, 1.9f, -0.1f);
const double significance_of_each = sidak(1e-4, 13);

// Compares the radiance along that ray by all techniques with that by directions alone. `count` and `planted_factor`
// are those of the long form.
void check_against_directions(Scene scene, std::uint32_t count, double planted_factor = 1.05) {
    count = samples_of(count);
    // 50 % more, because rare bright paths make the estimated errors vary.
    const double planted = phasetree::tests::long_tests() ? planted_factor : 1 + 1.5 * (detected(planted_factor) - 1);
    const World world(scene);
    const Moments all = radiance_along(world, scene, along_origin, along_direction, count, 1)[0];
    scene.settings.techniques = Techniques::directions_alone;
    const Moments alone = radiance_along(world, scene, along_origin, along_direction, 4 * count, 2)[0];
    const double error = std::hypot(all.standard_error(), alone.standard_error());
    CAPTURE(all.mean() / alone.mean());
    CAPTURE(all.standard_error() / alone.mean());
    CAPTURE(alone.standard_error() / alone.mean());
    CHECK(normal_two_sided((all.mean() - alone.mean()) / error) > significance_of_each);
    CHECK(normal_two_sided((planted * all.mean() - alone.mean()) / error) < significance_of_each);
    // Shadow rays find it, too, and not by luck.
    CHECK(all.variance() < 0.7 * alone.variance());
}

}  // namespace

TEST_CASE("below a ball that glows a floor is as bright as E = π L (r/d)²") {
    const double significance = sidak(1e-4, 6);
    Scene scene = scene_of(glowing(), hot(R"({"sphere": {"radius": 0.5}})", "[0, 0, 2]"), floor_of + ", " + dark);
    const World world(scene);
    for (const Techniques techniques : each_technique) {
        scene.settings.techniques = techniques;
        CAPTURE(static_cast<int>(techniques));
        // Directions alone rarely find a small ball.
        const bool is_by_luck = techniques == Techniques::directions_alone;
        check_radiance(world, scene, {0, 3, 1}, {0, -3, -1}, samples_of(is_by_luck ? 2'000'000 : 400'000),
                       8 * (0.5 / 2) * (0.5 / 2) * 0.5, significance, is_by_luck ? 0.02 : 0.01);
    }
}

TEST_CASE("below a thin ball of flame a floor is as bright as E = ε V/d²") {
    // A ball with emission ε and almost no absorption sends ε V in each direction.
    constexpr double emission = 3, radius = 0.5, distance = 2;
    const double volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
    Scene scene = scene_of(
        R"("flame": {"clear": {"ior": 1, "emission": [3, 1.5, 0.75], "absorption": [1e-4, 1e-4, 1e-4]}})",
        R"({"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 2], "of": {"sphere": {"radius": 0.5}}}}}})",
        floor_of + ", " + dark);
    const World world(scene);
    // The mean of cos θ/d² over the ball is the value at its centre, because the function is harmonic.
    const double expected = emission * volume / (distance * distance) * 0.5 / std::numbers::pi;
    for (const Techniques techniques : each_technique) {
        scene.settings.techniques = techniques;
        CAPTURE(static_cast<int>(techniques));
        const bool is_by_luck = techniques == Techniques::directions_alone;
        check_radiance(world, scene, {0, 3, 1}, {0, -3, -1}, samples_of(is_by_luck ? 2'000'000 : 500'000), expected,
                       sidak(1e-4, 6), is_by_luck ? 0.02 : 0.01);
    }
}

TEST_CASE("what glows is as bright through glass that touches it as without, but for what the glass reflects") {
    // A plate that glows under a plate of glass, seen straight from above.
    const Scene scene = scene_of(glowing() + R"(, "glass": {"clear": {"ior": 1.5}})",
                                 R"({"over": [)" + hot(R"({"box": {"size": [8, 8, 1]}})", "[0, 0, -0.5]") +
                                     R"(, {"set": {"phase": "glass", "of": {"box": {"size": [8, 8, 2]}}}}]})",
                                 dark);
    const World world(scene);
    check_radiance(world, scene, {0, 0, 4}, {0, 0, -1}, samples_of(100'000), 8 * (1 - 0.04), 1e-4);
    // Within the glass it is n² times as bright.
    check_radiance(world, scene, {0, 0, 0.5}, {0, 0, -1}, 1000, 8 * 2.25, 1e-4);
}

TEST_CASE("within walls that glow with what they do not reflect everything is as bright") {
    // Basic radiance (over the square of the index) is 1 everywhere. A lens touches a wall, and so does varnish.
    Scene scene = scene_of(
        R"("wall": {"glowing": {"radiance": 0.3, "color": [0.7, 0.7, 0.7]}}, "glass": {"clear": {"ior": 1.5}},
           "air": {"clear": {"ior": 1}}, "milk": {"clear": {"ior": 1.3, "scattering": [2, 2, 2]}})",
        R"({"over": [{"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, -1], "of": {"sphere": {"radius": 0.5}}}}}},
                     {"set": {"phase": "milk", "of": {"translate": {"by": [0.6, 0.4, 0.2], "of": {"sphere": {"radius": 0.3}}}}}},
                     {"set": {"phase": "air", "of": {"box": {"size": [2, 2, 2]}}}},
                     {"set": {"phase": "wall", "of": {"box": {"size": [3, 3, 3]}}}}]})",
        dark);
    const World world(scene);
    Uniform random(7);
    for (int i = 0; i < 12; ++i) {
        const glm::vec3 direction = square_to_uniform_sphere(random.two());
        const auto m = radiance_along(world, scene, {-0.1f, 0.2f, 0.1f}, direction, samples_of(20'000), 3);
        CAPTURE(m[0].mean());
        CAPTURE(m[0].standard_error());
        CHECK(std::abs(m[0].mean() - 1) < 5 * m[0].standard_error() + 1e-6);
        CHECK(m[0].standard_error() < detected(1.01) - 1);
    }
}

TEST_CASE("shadow rays and directions find the same light of surfaces that glow") {
    SUBCASE("a ring") {
        check_against_directions(scene_of(glowing(), hot(torus, "[0, 0, 1]"), floor_of + ", " + dark), 60'000);
    }
    SUBCASE("a ring within a slab of glass, through which it shines") {
        check_against_directions(
            scene_of(
                glowing() + R"(, "glass": {"clear": {"ior": 1.4}})",
                R"({"over": [)" + hot(torus, "[0, 0, 1]") +
                    R"(, {"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1], "of": {"box": {"size": [3, 3, 0.6]}}}}}}]})",
                floor_of + ", " + dark),
            60'000);
    }
    SUBCASE("a coil of thin wire") {
        check_against_directions(
            scene_of(glowing(),
                     hot(R"({"helix": {"radius": 0.3, "pitch": 0.2, "turns": 3, "wire_radius": 0.03}})", "[0, 0, 1]"),
                     floor_of + ", " + dark),
            100'000);
    }
    SUBCASE("before a lamp, whose light it hides, and below a sky") {
        check_against_directions(
            scene_of(
                glowing(), hot(R"({"sphere": {"radius": 0.4}})", "[0, 0, 1]"),
                floor_of + R"(, "lights": [{"sphere": {"centre": [0, 0, 4], "radius": 1.5, "radiance": [1, 0.5, 0.25]}},
                                                {"constant": {"radiance": [0.1, 0.05, 0.025]}}])"),
            60'000);
    }
    SUBCASE("before a point light, which it hides") {
        check_against_directions(
            scene_of(glowing(), hot(R"({"sphere": {"radius": 0.4}})", "[0, 0, 1]"),
                     floor_of + R"(, "lights": [{"point": {"position": [-0.1, -0.1, 5], "intensity": 50}}])"),
            60'000);
    }
    SUBCASE("a mesh") {
        check_against_directions(
            scene_of(
                R"("glass": {"clear": {"ior": 1.5}})",
                R"({"set": {"phase": "glass", "of": {"translate": {"by": [3, 3, 1], "of": {"sphere": {"radius": 0.5}}}}}})",
                R"("meshes": [{"floor": {"size": 40, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}},
                                   {"floor": {"height": 2, "size": 1, "material": {"glowing": {"radiance": 3}}}}], )" +
                    dark),
            60'000);
    }
    SUBCASE("copies of an object, one of which moves") {
        const Scene scene = read_scene(phasetree::Document::from_text(
            R"({"version": 1, "phases": {"hot": {"glowing": {"radiance": 8}}}, "lights": [],
                "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, "render": {"shutter": [0, 1]},
                "objects": [{"name": "ember", "tree": {"set": {"phase": "hot", "of": {"sphere": {"radius": 0.2}}}}}],
                "instances": [{"of": "ember", "transform": {"keys": [[0, {"translate": {"by": [0.5, 0, 1]}}],
                                                                     [1, {"translate": {"by": [0.9, 0, 1]}}]]}},
                              {"of": "ember", "transform": [{"scale": {"factor": 1.5}}, {"translate": {"by": [-0.5, 0.5, 1.2]}}]}],
                "meshes": [{"floor": {"size": 40, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}]})",
            "test.json"));
        check_against_directions(scene, 60'000);
    }
}

TEST_CASE("shadow rays and directions find the same light of flames") {
    SUBCASE("a flame, before a lamp") {
        check_against_directions(
            scene_of(
                R"("flame": {"clear": {)" + flame + "}}",
                R"({"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.4}}}}}})",
                floor_of +
                    R"(, "lights": [{"sphere": {"centre": [0, 0, 4], "radius": 1.5, "radiance": [1, 0.5, 0.25]}}])"),
            60'000);
    }
    SUBCASE("a flame of varying density within smooth glass, before a wall") {
        check_against_directions(
            scene_of(
                R"("flame": {"clear": {)" + flame +
                    R"(, "density": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.45}}}}, "density_depth": 0.3}},
                       "glass": {"clear": {"ior": 1.3}}, "wall": {"diffuse": {"color": [0.2, 0.2, 0.2]}})",
                R"({"over": [{"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.5}}}}}},
                                  {"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.7}}}}}},
                                  {"set": {"phase": "wall", "of": {"translate": {"by": [0, 0, 3], "of": {"box": {"size": [6, 6, 0.5]}}}}}}]})",
                floor_of + ", " + dark),
            60'000);
    }
    SUBCASE("a flame of temperatures at voxels") {
        const phasetree::support::TemporaryDirectory folder;
        for (int layer = 0; layer < 12; ++layer) {
            std::string image = "P5 6 6 255\n";
            for (int i = 0; i < 36; ++i) image += static_cast<char>(120 + 11 * layer);
            phasetree::support::write_text(folder / fmt::format("t_{:02}.pgm", layer), image);
        }
        check_against_directions(
            scene_of(
                fmt::format(
                    R"("flame": {{"clear": {{{}, "density": {{"translate": {{"by": [0, 0, 1], "of": {{"sphere": {{"radius": 0.45}}}}}}}},
                        "density_depth": 0.3, "temperature_grid": {{"file": "{}", "spacing": [0.2, 0.2, 0.1],
                        "translate": [0, 0, 1], "factor": 2200}}}}}})",
                    flame, (folder / "t_##.pgm").string()),
                R"({"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.5}}}}}})",
                floor_of + ", " + dark),
            60'000);
    }
    SUBCASE("embers in smoke that glows") {
        check_against_directions(
            scene_of(
                glowing() +
                    R"(, "smoke": {"clear": {"ior": 1, "scattering": [1, 1, 1], "emission": [0.5, 0.25, 0.125]}})",
                R"({"over": [)" + hot(R"({"sphere": {"radius": 0.2}})", "[0, 0, 1]") +
                    R"(, {"set": {"phase": "smoke", "of": {"translate": {"by": [0, 0, 1], "of": {"box": {"size": [1.5, 1.5, 1]}}}}}}]})",
                floor_of + ", " + dark),
            60'000);
    }
    SUBCASE("a flame below a plate, which hides a point light") {
        check_against_directions(
            scene_of(
                R"("flame": {"clear": {)" + flame + R"(}}, "plate": {"diffuse": {"color": [0.3, 0.3, 0.3]}})",
                R"({"over": [{"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.4}}}}}},
                                  {"set": {"phase": "plate", "of": {"translate": {"by": [0, 0, 1.8], "of": {"box": {"size": [3, 3, 0.1]}}}}}}]})",
                floor_of + R"(, "lights": [{"point": {"position": [-0.1, -0.1, 5], "intensity": 50}}])"),
            60'000);
    }
}

TEST_CASE("shadow rays and directions find the same light of what glows in glass that disperses it") {
    const auto in_dispersing_glass = [&](const std::string& phase, const std::string& shape) {
        return scene_of(
            phase + R"(, "glass": {"clear": {"ior": 1.4, "abbe_number": 20}})",
            R"({"over": [)" + shape +
                R"(, {"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1], "of": {"box": {"size": [3, 3, 1.2]}}}}}}]})",
            floor_of + ", " + dark);
    };
    constexpr std::uint32_t count = 160'000;
    constexpr double planted_factor = 1.07;
    SUBCASE("a ring within glass that disperses its light") {
        check_against_directions(in_dispersing_glass(glowing(), hot(torus, "[0, 0, 1]")), count, planted_factor);
    }
    SUBCASE("a flame within glass that disperses its light") {
        check_against_directions(
            in_dispersing_glass(
                R"("flame": {"clear": {"ior": 1.4, "emission": [16, 8, 4], "absorption": [0.5, 1, 2]}})",
                R"({"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.4}}}}}})"),
            count, planted_factor);
    }
}

TEST_CASE("a scene that nothing lights does not shine") {
    const std::string ball = R"({"set": {"phase": "stone", "of": {"sphere": {"radius": 1}}}})";
    const std::string phases = R"("stone": {"diffuse": {"color": [0.5, 0.5, 0.5]}}, )";
    CHECK_FALSE(scene_of(phases + glowing(), ball, dark).is_emissive());
    CHECK_FALSE(scene_of(R"("hot": {"glowing": {"light": [0, 0, 0]}})", hot(R"({"sphere": {"radius": 1}})"), dark)
                    .is_emissive());
    CHECK(scene_of(glowing(), hot(R"({"sphere": {"radius": 1}})"), dark).is_emissive());
}

TEST_CASE("what glows is of a group of lights") {
    const Scene scene = scene_of(glowing(R"(, "group": "embers")"), hot(R"({"sphere": {"radius": 0.5}})", "[0, 0, 2]"),
                                 floor_of + R"(, "lights": [{"constant": {"radiance": [0.5, 0.5, 0.5]}}])");
    REQUIRE(scene.lights.groups().size() == 2);
    CHECK(scene.lights.groups()[1] == "embers");
    const World world(scene);
    PathCounters counters;
    PathRecord record;
    double embers = 0, all = 0;
    for (std::uint32_t i = 0; i < 50'000; ++i) {
        Sampler sampler(i, 0, 0, 1);
        const Ray ray{{0, 3, 1}, glm::normalize(glm::vec3(0, -3, -1)), phasetree::vacuum, {}};
        all += static_cast<double>(trace_path(world, scene, ray, sampler, counters, &record).x);
        embers += static_cast<double>(record.groups[1].x);
        REQUIRE(record.groups[0].x + record.groups[1].x ==
                doctest::Approx(record.direct.x + record.indirect.x).epsilon(1e-4));
    }
    CHECK(embers / 50'000 == doctest::Approx(8 * 0.25 * 0.25 * 0.5).epsilon(0.02));
    CHECK(embers < 0.9 * all);
}

}  // namespace test_glowing
