// Dispersion: the colours of single wavelengths, measured indices, a prism, and energy that is neither lost nor added.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "caustics/caustics.hpp"
#include "shading/frame.hpp"
#include "spectrum/colour_matching.hpp"
#include "spectrum/daylight.hpp"
#include "spectrum/glasses.hpp"
#include "spectrum/primaries.hpp"
#include "tracer/support/paths.hpp"
#include "world/chain.hpp"

namespace test_dispersion {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// The mean over wavelengths of the contribution of f(wavelength) to red, green and blue.
template <class F>
glm::dvec3 mean_over_wavelengths(F&& f) {
    constexpr int count = 200000;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const Wavelength wavelength = sampled_wavelength((static_cast<float>(i) + 0.5f) / count);
        sum += glm::dvec3(wavelength.response) * static_cast<double>(f(Wavelengths::of_dispersed_colours(wavelength)));
    }
    return sum / static_cast<double>(count);
}

// The angle by which two refractions deflect a ray through a prism, traced through the world.
double deviation(const World& world, const Scene& scene, const glm::vec3& origin, const glm::vec3& direction,
                 const Wavelengths& only) {
    PathCounters counters;
    Ray ray{origin, direction, world.geometry().label(origin), {}};
    for (int face = 0; face < 2; ++face) {
        const Hit hit = world.geometry().intersect(ray, counters);
        REQUIRE(std::holds_alternative<Surface>(hit));
        const Surface& surface = std::get<Surface>(hit);
        REQUIRE(surface.optics.get().disperses());
        const Frame frame(surface.normal);
        const auto next = surface.bsdf(&only).sample(frame.to_local(-ray.direction), 0.999f, glm::vec2(0.0f));
        REQUIRE((next && next->transmitted));
        ray = continued(surface, frame, *next);
    }
    REQUIRE(clear_at(scene, ray.phase).ior == 1.0f);
    const glm::dvec3 a(direction), b(ray.direction);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

TEST_CASE("wavelengths: every colour is the mean of its own at single ones, and D65 is white") {
    for (const glm::vec3& colour : {glm::vec3(1, 1, 1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1),
                                    glm::vec3(0.8f, 0.3f, 0.1f)}) {
        const auto with_error = [&](float error) {
            const glm::dvec3 mean =
                mean_over_wavelengths([&](const Wavelengths& only) { return error * for_light(colour, &only).x; });
            return glm::length(mean - glm::dvec3(colour));
        };
        CHECK(with_error(1.0f) < 1e-3);
        CHECK(with_error(1.01f) > 1e-3);
    }
    double smallest = 1, largest = 0;
    for (double wavelength = 380; wavelength <= 780; wavelength += 0.7) {
        const glm::vec3 p = primaries_at(wavelength);
        CHECK(p.x + p.y + p.z == doctest::Approx(1.0f).epsilon(1e-6));
        smallest = std::min({smallest, static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
        largest = std::max({largest, static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
    CHECK(smallest >= 0);
    CHECK(largest <= 1);
    glm::dvec3 xyz(0.0);
    for (double wavelength = 380.5; wavelength < 780; wavelength += 1)
        xyz += daylight_at(wavelength) * colour_matching(wavelength);
    CHECK(xyz.x / (xyz.x + xyz.y + xyz.z) == doctest::Approx(0.3127).epsilon(2e-4));
    CHECK(xyz.y / (xyz.x + xyz.y + xyz.z) == doctest::Approx(0.3290).epsilon(2e-4));
}

TEST_CASE("glasses: the index and Abbe's number of the catalogues") {
    struct Known {
        const char* name;
        double index, abbe;
    };
    for (const Known& known : {Known{"bk7", 1.51680, 64.17}, Known{"f2", 1.62004, 36.37}, Known{"sf11", 1.78472, 25.68},
                               Known{"fused_silica", 1.45846, 67.82}, Known{"diamond", 2.4175, 55.3},
                               Known{"sapphire", 1.7682, 72.2}, Known{"water", 1.33335, 55.8}}) {
        CAPTURE(known.name);
        const Dispersion glass = find_glass(known.name).value().dispersion;
        const auto abbe = [](const Dispersion& of) {
            return (static_cast<double>(of.index(587.5618f)) - 1) /
                   static_cast<double>(of.index(486.1327f) - of.index(656.2725f));
        };
        CHECK(std::abs(static_cast<double>(glass.index(587.5618f)) - known.index) < 2e-4);
        CHECK(abbe(glass) == doctest::Approx(known.abbe).epsilon(0.01));
        const Dispersion cauchy(known.index, known.abbe);
        CHECK(cauchy.index(587.5618f) == doctest::Approx(known.index).epsilon(1e-6));
        CHECK(abbe(cauchy) == doctest::Approx(known.abbe).epsilon(1e-3));
    }
}

TEST_CASE("a prism: the least deviation is that of Sellmeier's index, at every wavelength") {
    // Its refracting edge of 60° is at the top, and its cross-section is in the plane of x and z.
    const Scene scene = scene_of(
        R"("glass": {"clear": {"glass": "sf11"}})",
        R"({"set": {"phase": "glass", "of": {"rotate": {"axis": [1, 0, 0], "angle": 90, "of": {"extrude": {"height": 2,
            "of": {"polygon": {"points": [[-1, -0.57735027], [1, -0.57735027], [0, 1.15470054]]}}}}}}}})");
    const World world(scene);
    CHECK(world.disperses());
    constexpr double half = std::numbers::pi / 6;
    for (const float u : {0.02f, 0.2f, 0.4f, 0.6f, 0.8f, 0.98f}) {
        const Wavelengths only = Wavelengths::of_dispersed_colours(sampled_wavelength(u));
        const double index = static_cast<double>(find_glass("sf11").value().dispersion.index(only.hero()));
        const auto least = [&](double n) { return 2 * std::asin(n * std::sin(half)) - 2 * half; };
        // In the symmetric case, the ray is horizontal inside, so outside it rises by half of the deviation.
        const double rise = 0.5 * least(index);
        double traced = 10;
        for (int i = -20; i <= 20; ++i) {
            const double angle = rise + i * 0.005;
            const glm::vec3 direction(static_cast<float>(std::cos(angle)), 0.0f, static_cast<float>(std::sin(angle)));
            const glm::vec3 at(-0.5f, 0.1f, 0.288675f);
            traced = std::min(traced, deviation(world, scene, at - 2.0f * direction, direction, only));
        }
        CAPTURE(only.hero());
        CHECK(std::abs(traced - least(index)) < 1e-4);
        CHECK(std::abs(traced - least(1 + 1.01 * (index - 1))) > 1e-4);
    }
}

TEST_CASE("dispersion adds and loses nothing: a furnace, and glass that hardly disperses") {
    const std::string ball = R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})";
    const double significance = sidak(1e-4, 9);
    const Scene furnace = scene_of(R"("glass": {"clear": {"glass": "diamond"}})", ball);
    const auto seen = radiance_along(World(furnace), furnace, {0, -5, 0.4f}, {0.05f, 1, 0}, samples_of(60000));
    for (const Moments& m : seen) {
        CHECK(mean_p_value(m, 1.0, 1e-3) > significance);
        CHECK(mean_p_value(m, detected(1.05), 1e-3) < significance);
    }
    const std::string lights = R"("lights": [{"gradient": {"zenith": [1, 0.2, 0.1], "horizon": [0.5, 0.6, 0.5],
                                                           "ground": [0.1, 0.2, 0.9]}}])";
    const auto through = [&](const std::string& abbe_number) {
        const Scene scene = scene_of(R"("glass": {"clear": {"ior": 1.5)" + abbe_number + "}}", ball, lights);
        return radiance_along(World(scene), scene, {0, -5, 0.4f}, {0.05f, 1, 0}, samples_of(60000));
    };
    const auto without = through(""), with = through(R"(, "abbe_number": 1000)");
    for (std::size_t c = 0; c < 3; ++c) {
        const double error = std::hypot(without[c].standard_error(), with[c].standard_error());
        const auto p_value = [&](double factor) {
            return phasetree::tests::normal_two_sided((factor * with[c].mean() - without[c].mean()) / error);
        };
        CAPTURE(with[c].mean() / without[c].mean());
        CHECK(p_value(1.0) > significance);
        CHECK(p_value(detected(1.1)) < significance);
    }
}

TEST_CASE("a fringe of colours: the edge of a shadow under flat flint glass, at each wavelength where it refracts to") {
    // A screen lies on the glass where x < 0, the floor is 1 below, and the sun stands at 70° from the vertical over x
    // > 0. Its light reaches below the screen by tan θ', where sin θ = n sin θ': violet by 0.59, red by 0.63.
    constexpr double sine = 0.93969262, cosine = 0.34202014, albedo = 0.001, irradiance = 1000;
    Scene scene = scene_of(
        R"("glass": {"clear": {"glass": "sf11"}}, "floor": {"diffuse": {"color": [0.001, 0.001, 0.001]}},
           "screen": {"diffuse": {"color": [0, 0, 0]}})",
        R"({"over": [{"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -1.5], "of": {"box": {"size": [60, 9, 1]}}}}}},
                     {"set": {"phase": "screen", "of": {"translate": {"by": [-15, 0, 0.1], "of": {"box": {"size": [30, 9, 0.2]}}}}}},
                     {"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, -0.75], "of": {"box": {"size": [60, 9, 1.5]}}}}}}]})",
        R"("lights": [{"sun": {"direction": [0.93969262, 0, 0.34202014], "irradiance": [1000, 1000, 1000], "diameter": 0.01}}])");
    const double significance = sidak(1e-4, 30);
    const Dispersion flint = find_glass("sf11").value().dispersion;
    for (const bool is_spectral : {false, true}) {
        scene.settings.spectral = is_spectral;
        const World world(scene);
        // The smallest p-value of all points and colours, for an edge that is 1 % away (2 % in the short form).
        double away = 1;
        for (const float below : {0.5f, 0.605f, 0.612f, 0.62f, 0.7f}) {
            const auto expected_at = [&](double edge) {
                return mean_over_wavelengths([&](const Wavelengths& only) {
                    const auto n = static_cast<double>(flint.index(only.hero()));
                    const double inside = sine / n, cosine_inside = std::sqrt(1 - inside * inside);
                    if (edge > inside / cosine_inside) return 0.0;
                    const double s = (cosine - n * cosine_inside) / (cosine + n * cosine_inside);
                    const double p = (n * cosine - cosine_inside) / (n * cosine + cosine_inside);
                    return albedo / std::numbers::pi * irradiance * cosine * (1 - 0.5 * (s * s + p * p));
                });
            };
            const glm::vec3 at(-below, 0.0f, -1.0f), from(-below, -0.5f, -0.1f);
            const auto seen = radiance_along(world, scene, from, at - from, samples_of(60000));
            const glm::dvec3 here = expected_at(double{below}), elsewhere = expected_at(detected(1.01) * double{below});
            CAPTURE(below);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto p_value = [&](const glm::dvec3& e) {
                    return mean_p_value(seen[c], e[static_cast<int>(c)], 1e-4);
                };
                CAPTURE(seen[c].mean());
                CAPTURE(here[static_cast<int>(c)]);
                CHECK(p_value(here) > significance);
                away = std::min(away, p_value(elsewhere));
            }
        }
        CHECK(away < significance);
    }
}

TEST_CASE("photons of one wavelength: the ground of a pool of flint glass under a point") {
    const Scene scene = scene_of(
        R"("water": {"clear": {"glass": "sf11"}}, "ground": {"diffuse": {"color": [0.001, 0.001, 0.001]}})",
        R"({"over": [{"set": {"phase": "ground", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [3, 3, 1]}}}}}},
                     {"set": {"phase": "water", "of": {"box": {"size": [3, 3, 2]}}}}]})",
        R"("lights": [{"point": {"position": [0, 0, 2], "intensity": 20}}],
           "render": {"width": 32, "height": 32, "photons": 8, "photon_radius": 1.5})");
    const World world(scene);
    const Caustics caustics(world, scene);
    // Straight below glass of depth 1, a point light at the height 1 over it appears at the distance 1 + 1/n.
    const glm::dvec3 expected = mean_over_wavelengths([&](const Wavelengths& only) {
        const double n = static_cast<double>(clear_at(scene, phasetree::Phase{1}).ior_for(&only));
        const double r = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
        return 20 * (1 - r) / ((1 + 1 / n) * (1 + 1 / n)) * 0.001 / std::numbers::pi;
    });
    std::array<Moments, 3> moments;
    PathCounters counters;
    const glm::vec3 from(-0.5f, -0.5f, 0.7f);
    const Ray ray{from, glm::normalize(-from), world.geometry().label(from), {}};
    // The short form runs half of the passes.
    const bool is_long = phasetree::tests::long_tests();
    for (int pass = 0; pass < (is_long ? 1600 : 800); ++pass) {
        const auto map = caustics.photons(pass, counters, [] { return false; });
        REQUIRE(map.has_value());
        Sampler sampler(static_cast<std::uint32_t>(pass), 0, 0, 1);
        const glm::vec3 radiance =
            trace_path(world, scene, ray, sampler, counters, nullptr, {.photons = {&caustics.emission(), &*map}});
        for (std::size_t c = 0; c < 3; ++c) moments[c].add(static_cast<double>(radiance[static_cast<int>(c)]));
    }
    const double significance = sidak(1e-4, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        const double e = expected[static_cast<int>(c)];
        CAPTURE(moments[c].mean() / e);
        CHECK(mean_p_value(moments[c], e, 3e-3 * e) > significance);
        CHECK(mean_p_value(moments[c], (is_long ? 1.3 : 1.43) * e, 3e-3 * e) < significance);
    }
}

}  // namespace test_dispersion
