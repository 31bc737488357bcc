// Photons: compared with closed forms behind flat interfaces, and with paths alone behind curved ones; and the map by
// itself.
#include "caustics/caustics.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "sampling/warps.hpp"
#include "shading/fresnel.hpp"
#include "support/uniform.hpp"
#include "tracer/caustics/photons.hpp"
#include "tracer/support/paths.hpp"

namespace test_caustics {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A dark floor, so that light which it reflects and which returns to it does not matter for the closed forms.
constexpr double albedo = 0.001;
const std::string floor_material = R"({"diffuse": {"color": [0.001, 0.001, 0.001]}})";
const std::string sun_at_60_degrees = R"({"sun": {"direction": [0, 0.8660254, 0.5], "irradiance": [4, 4, 4]}})";

// The member "render" for few photons, gathered within a large radius.
const std::string few_wide_photons = R"(, "render": {"width": 32, "height": 32, "photons": 8, "photon_radius": 6})";

// Checks that the floor below the hanging objects is as bright with photons as with paths alone.
void check_against_paths(const Scene& scene, int passes_of_photons, double significance) {
    phasetree::tracer::tests::check_against_paths(scene, {-2, -2, 0.1f}, {1.9f, 1.9f, -0.1f}, passes_of_photons,
                                                  significance);
}

double reflectance(double cosine, double eta) {
    return static_cast<double>(fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(eta)).reflectance);
}

}  // namespace

TEST_CASE("the sun through a pane, and at the ground of a pool: closed forms") {
    const double significance = sidak(1e-4, 2);
    const double irradiance = 4 * 0.5 / std::numbers::pi * albedo;
    const double r = reflectance(0.5, 1.5);
    const auto scene_with = [&](const std::string& phases, const std::string& tree, const std::string& meshes) {
        return scene_of(phases, tree, meshes + R"("lights": [)" + sun_at_60_degrees + "]" + few_wide_photons);
    };
    SUBCASE("a pane over the floor") {
        const Scene scene = scene_with(
            R"("glass": {"clear": {"ior": 1.5}})",
            R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 0.5], "of": {"box": {"size": [3, 3, 0.2]}}}}}})",
            R"("meshes": [{"floor": {"material": )" + floor_material + "}}], ");
        // (1 − r)² Σ r^(2k): the light that passes after any number of reflections inside.
        const double expected = irradiance * (1 - r) / (1 + r);
        const Moments m = with_photons(scene, {-1, -1, 0.2f}, {1, 1, -0.2f});
        CAPTURE(m.mean() / expected);
        CHECK(mean_p_value(m, expected, 1e-3 * expected) > significance);
        CHECK(mean_p_value(m, planted * expected, 1e-3 * expected) < significance);
    }
    SUBCASE("the ground of a pool, where the index is not 1") {
        const Scene scene = scene_with(
            R"("water": {"clear": {"ior": 1.5}}, "ground": )" + floor_material,
            R"({"over": [{"set": {"phase": "ground", "of": {"translate": {"by": [0, 0, -1], "of": {"box": {"size": [3, 12, 1]}}}}}},
                         {"set": {"phase": "water", "of": {"box": {"size": [3, 12, 2]}}}}]})",
            "");
        // Seen from within the water, far enough from the sides that light which enters there falls elsewhere.
        const Moments m = with_photons(scene, {-0.5f, -0.5f, 0.2f}, {0.5f, 0.5f, -0.7f});
        const double expected = irradiance * (1 - r);
        CAPTURE(m.mean() / expected);
        CHECK(mean_p_value(m, expected, 1e-3 * expected) > significance);
        CHECK(mean_p_value(m, planted * expected, 1e-3 * expected) < significance);
    }
}

TEST_CASE("a point above a pane, and above a pool: closed forms") {
    // Seen from straight below, inside a medium of index n, a point light at the height h above its flat surface
    // appears at the height h n.
    const double significance = sidak(1e-4, 2);
    const double r = reflectance(1, 1.5), intensity = 20;
    const auto check_radiance = [&](const Scene& scene, const glm::vec3& from, double irradiance) {
        const double expected = irradiance / std::numbers::pi * albedo;
        const Moments m = with_photons(scene, from, -from);
        CAPTURE(m.mean() / expected);
        CHECK(mean_p_value(m, expected, 2e-3 * expected) > significance);
        CHECK(mean_p_value(m, planted * expected, 2e-3 * expected) < significance);
        // Only photons find this light.
        CHECK(radiance_along(World(scene), scene, from, -from, 1000)[0].mean() < 1e-4 * expected);
    };
    // Around that point, the floor is darker by 3/4 of (radius/distance)², for which the tolerance is 0.2 %.
    const std::string near_photons = R"(, "render": {"width": 32, "height": 32, "photons": 8, "photon_radius": 1.5})";
    const std::string point = R"("lights": [{"point": {"position": [0, 0, 2], "intensity": 20}}])";
    SUBCASE("a pane over the floor") {
        // Light that passes straight, and light that is reflected twice inside, which comes from farther away. More
        // reflections are negligible.
        const double once = 2 - 0.2 * (1 - 1 / 1.5), twice = once + 0.4 / 1.5;
        const double passed = (1 - r) * (1 - r) * (1 / (once * once) + r * r / (twice * twice));
        check_radiance(
            scene_of(
                R"("glass": {"clear": {"ior": 1.5}})",
                R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 0.5], "of": {"box": {"size": [3, 3, 0.2]}}}}}})",
                R"("meshes": [{"floor": {"material": )" + floor_material + "}}], " + point + near_photons),
            {-1, -1, 0.2f}, intensity * passed);
    }
    SUBCASE("the ground of a pool, where the index is not 1") {
        const double away = 1 + 1 / 1.5;
        check_radiance(
            scene_of(
                R"("water": {"clear": {"ior": 1.5}}, "ground": )" + floor_material,
                R"({"over": [{"set": {"phase": "ground", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [3, 3, 1]}}}}}},
                                  {"set": {"phase": "water", "of": {"box": {"size": [3, 3, 2]}}}}]})",
                point + near_photons),
            {-0.5f, -0.5f, 0.7f}, intensity * (1 - r) / (away * away));
    }
}

TEST_CASE("behind a ball of coloured glass, or of what scatters, it is as bright as by paths alone") {
    const std::string sun = R"({"sun": {"direction": [0.2, 0.3, 1], "irradiance": [4, 4, 4], "diameter": 90}})";
    const std::string rectangle = R"({"rectangle": {"centre": [1, 1, 4], "target": [0, 0, 0], "width": 6, "height": 6,
                                      "radiance": [5, 5, 5]}})";
    const std::string sphere = R"({"sphere": {"centre": [1, 1, 4], "radius": 2, "radiance": [5, 5, 5]}})";
    const std::string coloured = R"("absorption": [0.3, 0.3, 0.3])";
    // Photons lose all light that is scattered on their way. Paths find it.
    const std::string murky = R"("absorption": [0.1, 0.1, 0.1], "scattering": [0.5, 0.5, 0.5], "anisotropy": 0.3)";
    const std::string cloudy = R"("scattering": [1, 1, 1], "density_depth": 0.5, "density": {"translate":
                                  {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 0.8}}}})";
    struct Case {
        std::string light, inside;
        int passes;  // in multiples: the sphere's photons differ most in their power
    };
    std::vector<Case> cases{{sun, coloured, 1}, {rectangle, cloudy, 1}};
    // Photons in scattering media are in caustics_in_media.cpp.
    if (long_form) cases.insert(cases.end(), {{sphere, coloured, 3}, {rectangle, coloured, 1}, {sun, murky, 1}});
    const double significance = sidak(1e-4, cases.size());
    for (const Case& c : cases) {
        CAPTURE(c.light);
        CAPTURE(c.inside);
        const Scene scene = scene_of(
            R"("glass": {"clear": {"ior": 1.2, )" + c.inside + "}}",
            R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}})",
            R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], "lights": [)" + c.light +
                R"(], "render": {"width": 64, "height": 64, "photons": 3, "photon_radius": 2})");
        check_against_paths(scene, c.passes * passes, significance);
    }
}

TEST_CASE("lines are as dense from lamps in clusters as from the same lamps one by one") {
    std::string centres;
    for (int i = 0; i < 60; ++i)
        centres +=
            fmt::format("{}[{}, {}, {}]", i > 0 ? ", " : "", 0.9 * (i % 8) - 3, 0.8 * (i / 8) - 3, 3 + 0.3 * (i % 3));
    const Scene clustered = scene_of(
        R"("glass": {"clear": {"ior": 1.5}})", R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})",
        R"("lights": [{"point": {"position": [0, 0, 4]}}, {"spheres": {"radius": 0.3, "centres": [)" + centres +
            R"(]}}, {"sun": {"direction": [0.1, 0.2, 1], "diameter": 40}}])");
    REQUIRE(clustered.lights.area().size() == 60);
    Scene one_by_one = clustered;
    one_by_one.lights = {};
    for (const auto& listed : clustered.lights.infinite()) one_by_one.lights.add(listed.light);
    for (const auto& listed : clustered.lights.area()) one_by_one.lights.add(listed.light);
    for (const auto& listed : clustered.lights.points()) one_by_one.lights.add(listed.light);
    const World world(clustered);
    const PhotonEmission a(world, clustered), b(world, one_by_one);
    phasetree::tests::Uniform random(5);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 origin(random() - 0.5f, random() - 0.5f, 1.1f);
        const glm::vec3 towards = square_to_uniform_sphere(random.two());
        const float density = b.line_density(origin, towards, phasetree::vacuum);
        REQUIRE(a.line_density(origin, towards, phasetree::vacuum) == doctest::Approx(density).epsilon(1e-5));
        met += density > 0;
    }
    CHECK(met > 2000);
}

TEST_CASE("light that passes between two balls of glass does not count as found by photons") {
    // Photons aim at both balls and at the space between them. Photons through that space were not bent, so they are
    // not kept.
    const Scene scene = scene_of(R"("glass": {"clear": {"ior": 1.2, "absorption": [0.3, 0.3, 0.3]}})",
                                 R"({"set": {"phase": "glass", "of": {"union": {"of": [
              {"translate": {"by": [-2, 0, 1.1], "of": {"sphere": {"radius": 1}}}},
              {"translate": {"by": [2, 0, 1.1], "of": {"sphere": {"radius": 1}}}}]}}}})",
                                 R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}],
           "lights": [{"sun": {"direction": [0.2, 0.3, 1], "irradiance": [4, 4, 4], "diameter": 20}}],
           "render": {"width": 64, "height": 64, "photons": 3, "photon_radius": 2})");
    // A few photons are bright. In fewer passes they are often missed, and the standard error is then too small.
    check_against_paths(scene, 2 * passes, 1e-4);
}

TEST_CASE("what glows before the sun, through a ball of glass, hides it from photons and sends its own") {
    // The sun is weak, and the glowing object in front of it is not.
    const Scene scene = scene_of(
        R"("glass": {"clear": {"ior": 1.2, "absorption": [0.3, 0.3, 0.3]}}, "hot": {"glowing": {"radiance": 4}})",
        R"({"over": [
              {"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}},
              {"set": {"phase": "hot", "of": {"translate": {"by": [0.3, 0.4, 4.2], "of": {"sphere": {"radius": 1.8}}}}}}]})",
        R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}],
           "lights": [{"sun": {"direction": [0.2, 0.3, 1], "irradiance": [0.01, 0.01, 0.01], "diameter": 60}}],
           "render": {"width": 64, "height": 64, "photons": 10, "photon_radius": 1.5})");
    check_against_paths(scene, passes, 1e-4);
}

TEST_CASE("a lamp in water, behind a ball of glass: as bright as by paths alone") {
    // The chain starts and ends where the index is not 1.
    const Scene scene = scene_of(
        R"("glass": {"clear": {"ior": 1.6}}, "water": {"clear": {"ior": 1.33}})",
        R"({"over": [{"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}},
                     {"set": {"phase": "water", "of": {"translate": {"by": [0, 0, 4.5], "of": {"box": {"size": [9, 9, 10]}}}}}}]})",
        R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.02, 0.02, 0.02]}}}}],
           "lights": [{"rectangle": {"centre": [1, 1, 4], "target": [0, 0, 0], "width": 6, "height": 6, "radiance": [5, 5, 5]}}],
           "render": {"width": 64, "height": 64, "photons": 3, "photon_radius": 2})");
    check_against_paths(scene, passes, 1e-4);
}

TEST_CASE("the bright parts of an image, through a ball of glass: as bright as by paths alone") {
    // Two suns with a diameter of a few degrees in a grey sky, rotated. One is on the seam of the image.
    constexpr int width = 96, height = 48;
    std::vector<glm::vec3> pixels(width * height, glm::vec3(0.3f));
    const auto shine = [&](int column, int row, float radiance) {
        for (int y = row; y < row + 3; ++y)
            for (int x = column; x < column + 3; ++x)
                pixels[static_cast<std::size_t>(y * width + x % width)] = glm::vec3(radiance);
    };
    shine(50, 6, 150);
    shine(94, 9, 90);
    Scene scene = scene_of(
        R"("glass": {"clear": {"ior": 1.2, "absorption": [0.3, 0.3, 0.3]}})",
        R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}})",
        R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], "lights": [],
           "render": {"width": 64, "height": 64, "photons": 3, "photon_radius": 2})");
    scene.lights.add(ImageEnvironment(width, height, pixels, 40.0f));
    CHECK(PhotonEmission(World(scene), scene).sources() == 2);
    check_against_paths(scene, 3 * passes, 1e-4);
}

TEST_CASE("the map finds what lies within the radius, each photon once") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-3, 3);
    TracedPhotons traced;
    std::vector<Photon>& photons = traced.on_surfaces;
    for (int i = 0; i < 3000; ++i)
        photons.push_back({{place(random), place(random), 0.1f * place(random)},
                           {0, 0, 1},
                           glm::vec3(1),
                           1,
                           phasetree::Phase{static_cast<std::uint8_t>(i % 2)},
                           {},
                           {0, 0, 1}});
    const float radius = 0.4f;
    const PhotonMap map(traced, 3000, radius);
    CHECK(map.expected() == doctest::Approx(3000 * std::numbers::pi * 0.16));
    const glm::vec3 normal(0, 0, 1);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 point(place(random), place(random), 0.0f);
        int found = 0, expected = 0;
        map.near(point, normal, [&](const Photon& photon) { found += photon.phase == phasetree::Phase{1}; });
        for (const Photon& photon : photons) {
            const glm::vec3 offset = photon.position - point;
            expected += photon.phase.index == 1 && glm::length(offset) <= radius && std::abs(offset.z) <= radius / 4;
        }
        CHECK(found == expected);
    }
}

TEST_CASE("no photons where nothing bends light or no light has a middle") {
    const auto lights = [](const std::string& ior, const std::string& light) {
        const Scene scene =
            scene_of(R"("glass": {"clear": {"ior": )" + ior + "}}",
                     R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})", R"("lights": [)" + light + "]");
        const World world(scene);
        return PhotonEmission(world, scene).sources();
    };
    CHECK(lights("1.5", sun_at_60_degrees) == 1);
    CHECK(lights("1", sun_at_60_degrees) == 0);
    CHECK(lights("1.5", R"({"constant": {}})") == 0);
}

TEST_CASE("photons of a flame start in it, and nowhere else") {
    const Scene scene = scene_of(
        R"("glass": {"clear": {"ior": 1.5}}, "flame": {"clear": {"ior": 1, "emission": [1, 1, 1], "absorption": [0.001, 0.001, 0.001]}})",
        R"({"over": [{"set": {"phase": "flame", "of": {"translate": {"by": [0, 0, 2], "of": {"capsule": {"from": [-1, -1, 0], "to": [1, 1, 0.3], "radius": 0.05}}}}}},
                     {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}]})",
        R"("lights": [])");
    const World world(scene);
    const PhotonEmission emission(world, scene);
    CHECK(emission.sources() == scene.lights.emissive_parts().size());
    int started = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        Sampler sampler(i, 0, 0, 7);
        const auto photon = emission.sample(sampler, 0);
        if (!photon) continue;
        ++started;
        CHECK(photon->ray.phase == world.geometry().label(photon->ray.origin));
        CHECK(photon->emission.radiance.x > 0.0f);
        CHECK(photon->emission.radiance.x < 3.0f);  // at most the flame's length
    }
    // The flame fills less than a hundredth of its bounding box, and its balls are larger than the flame by at least
    // half.
    CHECK(started > 400);
}

TEST_CASE("a lamp above a wall throws no photons through what is below it") {
    const auto found_on_the_floor = [](const std::string& lamp_height) {
        const Scene scene = scene_of(
            R"("glass": {"clear": {"ior": 1.5}})",
            R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}})",
            R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}, {"floor": {"height": 3, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
               "lights": [{"rectangle": {"centre": [0, 0, )" +
                lamp_height + R"(], "target": [0, 0, 0], "width": 1, "height": 1, "radiance": [5, 5, 5]}}])" +
                few_wide_photons);
        const World world(scene);
        const Caustics caustics(world, scene);
        PathCounters counters;
        const auto map = caustics.photons(0, counters, [] { return false; });
        REQUIRE(map.has_value());
        int found = 0;
        for (const float x : {-0.2f, -0.1f, 0.0f, 0.1f, 0.2f})
            map->near({x, 0, 0}, {0, 0, 1}, [&](const Photon&) { ++found; });
        return found;
    };
    CHECK(found_on_the_floor("2.9") > 0);
    CHECK(found_on_the_floor("3.1") == 0);
}

TEST_CASE("a lamp hides the sun from the photons") {
    const auto of_the_sun = [](const std::string& target_height) {
        const Scene scene = scene_of(
            R"("glass": {"clear": {"ior": 1.5}})",
            R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}})",
            R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
               "lights": [{"sun": {"direction": [0, 0, 1], "irradiance": [4, 4, 4]}},
                          {"rectangle": {"centre": [0, 0, 2.2], "target": [0, 0, )" +
                target_height + R"(], "width": 6, "height": 6, "radiance": [5, 5, 5]}}])" + few_wide_photons);
        const World world(scene);
        int found = 0;
        for_each_photon(world, scene, PhotonEmission(world, scene), 3000,
                        [&](const EmittedPhoton& emitted, const Photon&) {
                            found += std::holds_alternative<InfiniteLights>(emitted.emission.source);
                        });
        return found;
    };
    // From below, the sun is visible only if it emits upward.
    CHECK(of_the_sun("0") == 0);
    CHECK(of_the_sun("9") > 100);
}

TEST_CASE("lamps within the object's sphere, before a sun and before each other: no light is lost or found twice") {
    // The lower lamp shines down, and then up.
    for (const char* const target : {"0", "9"}) {
        CAPTURE(std::string(target));
        const auto made = [&](bool caustics) {
            return scene_of(
                R"("glass": {"clear": {"ior": 1.2, "absorption": [0.3, 0.3, 0.3]}})",
                R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}}}})",
                fmt::format(
                    R"("meshes": [{{"floor": {{"material": {{"diffuse": {{"color": [0.6, 0.6, 0.6]}}}}}}}}],
               "lights": [{{"sun": {{"direction": [0.1, 0.1, 1], "irradiance": [4, 4, 4], "diameter": 50}}}},
                          {{"rectangle": {{"centre": [0, 0, 2.3], "target": [0, 0, {}], "width": 0.9, "height": 0.9, "radiance": [5, 5, 5]}}}},
                          {{"rectangle": {{"centre": [0.2, 0, 2.6], "target": [0, 0, 0], "width": 0.7, "height": 0.7, "radiance": [9, 9, 9]}}}}],
               "camera": {{"position": [0.3, -6, 0.9], "look_at": [0, 0, -0.7], "fov": 20}},
               "render": {{"width": 48, "height": 24, "samples": {}, "caustics": {}}})",
                    target, long_form ? 64 : 12, caustics));
        };
        check_pictures(made, long_form ? 1.01 : 1.03, sidak(1e-4, 2));
    }
}

TEST_CASE("a target's lines are as dense as it says") {
    PhotonTarget target({1, 2, 3}, glm::normalize(glm::vec3(1, 1, 2)), 0.7f);
    std::vector<double> weights(target.bins());
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    for (double& weight : weights) weight = static_cast<double>(unit(random)) + 0.01;
    target.set_weights(weights);
    // The mean of 1/p over samples is the measure of all lines of one direction: the square's area, seen from there.
    const glm::vec3 direction = glm::normalize(glm::vec3(0.5f, 1, 2));
    Moments inverse;
    for (int i = 0; i < 20000; ++i) {
        const PhotonTarget::Sample aim = target.sample(unit(random), {unit(random), unit(random)});
        const float density = target.crossing(aim.point - 2.0f * direction, direction).density;
        if (density > 0) inverse.add(1 / static_cast<double>(density));
    }
    const double area = 1.4 * 1.4 * static_cast<double>(glm::dot(direction, glm::normalize(glm::vec3(1, 1, 2))));
    CHECK(mean_p_value(inverse, area, 0) > 1e-4);
    CHECK(mean_p_value(inverse, 1.03 * area, 0) < 1e-4);
}

}  // namespace test_caustics
