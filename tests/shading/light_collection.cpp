// All lights together: the density of the mixture, the light that samples and rays find, and multiple importance
// sampling.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "image/luminance.hpp"
#include "light_checks.hpp"
#include "lights/daylight.hpp"
#include "lights/lights.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"

namespace test_light_collection {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();

const glm::vec3 towards_sun = glm::normalize(glm::vec3(-0.6f, 0.0f, 0.8f));

// An environment, a wide sun, a rectangle, and a sphere that hides part of the rectangle from the origin; the sun's
// disk is partly behind the rectangle.
Lights everything() {
    Lights lights;
    lights.add(ConstantEnvironment(glm::vec3(0.5f)));
    lights.add(Sun(towards_sun, glm::vec3(1.0f), 20.0f));
    lights.add(RectangleLight::facing({-0.5f, 0.0f, 2.0f}, {-0.5f, 0.0f, 0.0f}, 1.5f, 1.0f, glm::vec3(3.0f)));
    lights.add(SphereLight({0.3f, 0.0f, 1.0f}, 0.25f, glm::vec3(2.0f), false));
    return lights;
}

// The radiance along a ray from p if there is no geometry.
Lights::Emission seen(const Lights& lights, const glm::vec3& p, const glm::vec3& w, bool camera_ray = false) {
    return lights.seen(p, w, infinity, camera_ray).value();
}

// ∫ L max(0, n·ω) dω, by the midpoint rule on a grid of 1,024² directions. Edges of lights cross a few in a thousand of
// its cells, with random sign, so the error is about 1e-4, a fifth of the statistical error.
double irradiance_by_quadrature(const Lights& lights, const glm::vec3& p, const glm::vec3& normal, int finer = 1024) {
    return sum_of(lat_long_probabilities(1, 1, finer, [&](const glm::vec3& w) {
        const float cosine = glm::dot(normal, w);
        return cosine > 0.0f ? static_cast<double>(luminance(seen(lights, p, w).radiance) * cosine) : 0.0;
    }));
}

}  // namespace

TEST_CASE("lights: samples and rays agree on radiance, distance and density") {
    const Lights lights = everything();
    Uniform random(1);
    int infinite = 0;
    int area = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 p(random() - 0.5f, random() - 0.5f, 0.3f * random());
        const auto s = lights.sample(p, random.two());
        if (!s) continue;
        const auto again = seen(lights, p, s->wi);
        REQUIRE(again.distance == s->distance);
        REQUIRE(again.radiance == s->radiance);
        REQUIRE(lights.pdf(p, s->wi) == doctest::Approx(s->pdf).epsilon(1e-5));
        REQUIRE(std::abs(glm::length(s->wi) - 1.0f) < 1e-6f);
        (s->distance == infinity ? infinite : area) += 1;
    }
    CHECK(infinite + area > 99900);  // almost nothing is lost to rounding at rims
    CHECK(infinite > 1000);
    CHECK(area > 1000);
}

TEST_CASE("lights: of a lamp so small that rounding misses it, what missed is no sample") {
    Lights lights;
    lights.add(ConstantEnvironment(glm::vec3(1e-6f)));
    // Its angular size is 1e-6, and the rounding error of a direction, 6e-8, is more than a hundredth of that.
    const auto lamp = RectangleLight::facing({700000, 600000, 800000}, {0, 0, 0}, 1.3f, 1.1f, glm::vec3(1e7f));
    lights.add(lamp);
    const glm::vec3 p(0.0f);
    Uniform random(12);
    int samples = 0, misses = 0, proposals = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec2 u = random.two();
        misses += lamp.intersect(p, lamp.sample(p, u).direction) ? 0 : 1;
        ++proposals;
        const auto s = lights.sample(p, u);
        if (!s) continue;
        ++samples;
        REQUIRE(lights.pdf(p, s->wi) == doctest::Approx(s->pdf).epsilon(1e-3));
    }
    CHECK(misses > proposals / 200);
    CHECK(samples > proposals / 2);
}

TEST_CASE("lights: a direction that several lights can propose counts all of them") {
    const Lights lights = everything();
    const glm::vec3 p(0.0f);
    // Fluences, and from them the shares: environment, sun, rectangle, sphere. A uniform environment counts with only a
    // tenth of its fluence, because paths find it without help.
    const auto lamp = RectangleLight::facing({-0.5f, 0.0f, 2.0f}, {-0.5f, 0.0f, 0.0f}, 1.5f, 1.0f, {});
    const double rectangle_angle = lamp.solid_angle(p);
    const double sphere_angle = SphereLight({0.3f, 0.0f, 1.0f}, 0.25f, {}).solid_angle(p);
    const double sun_radius = 10.0 * half_turn / 180.0;
    const double sun_angle = 2.0 * half_turn * (1.0 - std::cos(sun_radius));
    const double environment = 0.1 * 0.5 * 4.0 * half_turn;
    const double sun = sun_angle / (half_turn * std::pow(std::sin(sun_radius), 2.0));
    const double rectangle = 3.0 * lamp.approximate_solid_angle(p);
    const double sphere = 2.0 * sphere_angle;
    const double total = environment + sun + rectangle + sphere;

    const auto density = [&](bool in_sun, bool in_rectangle, bool in_sphere) {
        return (environment / (4.0 * half_turn) + (in_sun ? sun / sun_angle : 0.0) +
                (in_rectangle ? rectangle / rectangle_angle : 0.0) + (in_sphere ? sphere / sphere_angle : 0.0)) /
               total;
    };
    const auto pdf = [&](const glm::vec3& to) { return lights.pdf(p, glm::normalize(to)); };
    CHECK(pdf({0, 0, -1}) == doctest::Approx(density(false, false, false)).epsilon(1e-5));
    CHECK(pdf({-0.4f, 0.4f, 2}) == doctest::Approx(density(false, true, false)).epsilon(1e-5));
    CHECK(pdf({0.3f, 0, 1}) == doctest::Approx(density(false, false, true)).epsilon(1e-5));
    CHECK(pdf({0.2f, 0, 2}) == doctest::Approx(density(false, true, true)).epsilon(1e-5));
    CHECK(pdf(towards_sun) == doctest::Approx(density(true, false, false)).epsilon(1e-5));
    CHECK(pdf({-1.2f, 0, 2}) == doctest::Approx(density(true, true, false)).epsilon(1e-5));
    CHECK(seen(lights, p, glm::normalize(glm::vec3(0.2f, 0, 2))).radiance.x == 2.0f);
    CHECK(seen(lights, p, towards_sun, false).radiance.x > 1.5f);
    CHECK(seen(lights, p, {0, 0, -1}).radiance.x == 0.5f);
}

TEST_CASE("lights: light from all around is chosen by what of it is above its mean") {
    CHECK(DiffuseIrradiance(ConstantEnvironment(glm::vec3(0.5f))).unevenness() == doctest::Approx(0.1f));
    CHECK(DiffuseIrradiance(ConstantEnvironment(glm::vec3(0.0f))).unevenness() == 1.0f);  // it is never chosen
    // L = S(|z|) above and 0 below, S(t) = t² (3 − 2t): the mean is 1/4, above which L is from z = 0.32635 on. There
    // ∫ (L − 1/4) dz = 0.298, of all that is 1/2.
    const GradientEnvironment above(glm::vec3(1), glm::vec3(0), glm::vec3(0), 1.0f);
    double sum = 0.0, all = 0.0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps, radiance = z * z * (3.0 - 2.0 * z);
        sum += std::max(radiance - 0.25, 0.0);
        all += radiance;
    }
    CHECK(DiffuseIrradiance(above).unevenness() == doctest::Approx(sum / all).epsilon(0.01));
    // A sun in a grey sky has almost all of the light.
    std::vector<glm::vec3> sky(256 * 128, glm::vec3(0.1f));
    sky[40 * 256 + 30] = glm::vec3(1e5f);
    CHECK(DiffuseIrradiance(ImageEnvironment(256, 128, sky)).unevenness() > 0.9f);
}

TEST_CASE("lights: a portal is examined as before, however even the sky is") {
    // The fluence of the lamp is a tenth of the sky's. Without a portal the sky is chosen half of the time; with one,
    // ten times in eleven, three quarters of which go to the portal.
    const glm::vec3 p(0.0f);
    const auto lights_with = [&](bool portal) {
        Lights lights;
        lights.add(ConstantEnvironment(glm::vec3(1.0f)));
        lights.add(SphereLight({0, 0, 3}, 1.0f, glm::vec3(0.1f * 4 / (2 * (1 - std::sqrt(8.0f / 9.0f))))));
        if (portal)
            lights.add(Portal(RectangleLight::facing({3, 0, 0}, {0, 0, 0}, 1.0f, 1.0f, glm::vec3(0.0f), false)));
        return lights;
    };
    const glm::vec3 elsewhere(0, 0, -1);
    CHECK(lights_with(false).pdf(p, elsewhere) == doctest::Approx(0.5 / (4 * half_turn)).epsilon(1e-4));
    CHECK(lights_with(true).pdf(p, elsewhere) == doctest::Approx(0.25 / 1.1 / (4 * half_turn)).epsilon(1e-4));
}

TEST_CASE("lights: the density integrates to 1 and samples follow it") {
    const Lights lights = everything();
    for (const glm::vec3 p : {glm::vec3(0.0f), glm::vec3(0.3f, 0.1f, 1.0f)}) {
        CAPTURE(p.x);
        constexpr int columns = 8;
        constexpr int rows = 8;
        const auto probability = lat_long_probabilities(
            columns, rows, 128, [&](const glm::vec3& w) { return static_cast<double>(lights.pdf(p, w)); });
        // On a grid of 1,024² cells; edges of lights cross a few in a thousand of them, with random sign.
        CHECK(sum_of(probability) == doctest::Approx(1.0).epsilon(1e-3));
        check_directions(
            probability,
            [&](const glm::vec2& u) -> std::optional<glm::vec3> {
                const auto s = lights.sample(p, u);
                if (!s) return std::nullopt;
                return s->wi;
            },
            [](const glm::vec3& w) { return lat_long_bin(columns, rows, w); });
    }
}

TEST_CASE("lights: light samples, BSDF samples and both together estimate the same integral") {
    Lights day;
    const Daylight daylight_parts =
        make_daylight({.sun_elevation_degrees = 40.0f, .sun_angular_diameter_degrees = 4.0f});
    day.add(daylight_parts.sky);
    day.add(daylight_parts.sun);
    Lights sky;
    sky.add(daylight_parts.sky);
    struct Case {
        std::string name;
        Lights lights;
        double expected;
        bool bsdf_alone;  // cosine samples find the light often enough to be tested alone
    };
    const glm::vec3 p(0.0f, 0.0f, 0.05f);
    const glm::vec3 normal = glm::normalize(glm::vec3(0.1f, 0.1f, 1.0f));
    // The sun's disk is too small for the grid; it is L π sin²α cos θ.
    const double sun = luminance(daylight_parts.sun.radiance(daylight_parts.sun.direction())) * half_turn *
                       std::pow(std::sin(2.0 * half_turn / 180.0), 2.0) *
                       glm::dot(normal, daylight_parts.sun.direction());
    Lights rectangle;
    rectangle.add(RectangleLight::facing({0.5f, 0.2f, 1.5f}, {0, 0, 0}, 1.0f, 1.0f, glm::vec3(1.0f)));
    // Samples of the rectangle alone vary so little that the grid's error at its edges shows, so it needs a finer grid.
    const Case cases[] = {{"everything", everything(), irradiance_by_quadrature(everything(), p, normal), true},
                          {"sky and sun", day, irradiance_by_quadrature(sky, p, normal) + sun, false},
                          {"rectangle", rectangle, irradiance_by_quadrature(rectangle, p, normal, 4096), true}};
    const auto cosine_density = [&](const glm::vec3& w) { return cosine_hemisphere_pdf(glm::dot(normal, w)); };
    for (const Case& test : cases) {
        CAPTURE(test.name);
        const Lights& lights = test.lights;
        const double expected = test.expected;

        const auto by_light = [&](Uniform& random, bool weigh) {
            const auto s = lights.sample(p, random.two());
            if (!s || glm::dot(normal, s->wi) <= 0.0f) return 0.0;
            const float weight = weigh ? s->pdf / (s->pdf + cosine_density(s->wi)) : 1.0f;
            return static_cast<double>(weight * luminance(s->radiance) * glm::dot(normal, s->wi) / s->pdf);
        };
        const auto by_bsdf = [&](Uniform& random, bool weigh) {
            const glm::vec3 w = Frame(normal).to_world(square_to_cosine_hemisphere(random.two()));
            const float density = cosine_density(w);
            if (!(density > 0.0f)) return 0.0;
            const auto emission = seen(lights, p, w);
            const float weight = weigh ? density / (density + lights.pdf(p, w)) : 1.0f;
            return static_cast<double>(weight * luminance(emission.radiance) * glm::dot(normal, w) / density);
        };
        check(estimator_test(expected, 1000000, [&](Uniform& r) { return by_light(r, false); }));
        check(estimator_test(expected, 1000000, [&](Uniform& r) { return by_light(r, true) + by_bsdf(r, true); }));
        if (test.bsdf_alone) {
            check(estimator_test(expected, 2500000, [&](Uniform& r) { return by_bsdf(r, false); }));
        }
    }
}

TEST_CASE("lights: visibility to the camera, background, and occlusion") {
    Lights lights = everything();
    const glm::vec3 p(0.0f);
    const glm::vec3 to_both = glm::normalize(glm::vec3(0.2f, 0.0f, 2.0f));
    // The sphere in front is invisible to the camera, the rectangle behind it is not.
    CHECK(seen(lights, p, to_both, true).radiance.x == 3.0f);
    CHECK(seen(lights, p, to_both, false).radiance.x == 2.0f);
    CHECK(lights.seen(p, to_both, 0.5f, false) == std::nullopt);
    const float to_rectangle = seen(lights, p, to_both, true).distance;
    CHECK(to_rectangle == doctest::Approx(2.0 / to_both.z));
    CHECK_FALSE(lights.seen(p, to_both, to_rectangle, true));

    lights.set_background(glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(seen(lights, p, towards_sun, true).radiance == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(seen(lights, p, towards_sun, false).radiance.x > 1.5f);
    lights.set_background(std::nullopt);
    CHECK(seen(lights, p, towards_sun, true).radiance.x > 1.5f);
}

TEST_CASE("lights: none, black ones, and ones that are turned away yield nothing") {
    Lights lights;
    CHECK(lights.empty());
    CHECK_FALSE(lights.sample(glm::vec3{}, {0.5f, 0.5f}));
    CHECK(seen(lights, {}, {0, 0, 1}, true).distance == infinity);
    CHECK(seen(lights, {}, {0, 0, 1}, true).radiance == glm::vec3(0.0f));
    CHECK(lights.pdf(glm::vec3{}, {0, 0, 1}) == 0.0f);
    lights.add(ConstantEnvironment(glm::vec3(0.0f)));
    lights.add(RectangleLight::facing({0, 0, 1}, {0, 0, 2}, 1, 1, glm::vec3(1.0f)));
    CHECK_FALSE(lights.empty());
    CHECK_FALSE(lights.sample(glm::vec3{}, {0.5f, 0.5f}));
    CHECK(lights.sample(glm::vec3{0, 0, 2}, {0.5f, 0.5f}));
    // A light with a share of zero is never chosen, even at either end of the range.
    lights.add(ConstantEnvironment(glm::vec3(0.0f)));
    for (const float choice : {0.0f, 0x1.fffffep-1f}) {
        CHECK(lights.sample(glm::vec3{0, 0, 2}, {choice, 0.5f})->radiance.x == 1.0f);
    }
    CHECK_FALSE(lights.sample(glm::vec3(std::numeric_limits<float>::quiet_NaN()), {0.5f, 0.5f}));
}

TEST_CASE("lights: the brightest one that has a place, on one side") {
    const glm::vec3 up(0, 0, 1), p(0.5f, 0, 0);
    Lights lights;
    CHECK_FALSE(lights.towards_brightest(p, up));
    lights.add(ConstantEnvironment(glm::vec3(100.0f)));  // visible in all directions
    CHECK_FALSE(lights.towards_brightest(p, up));
    const Sun sun({3, 0, 4}, glm::vec3(1.0f));
    lights.add(sun);
    CHECK(lights.towards_brightest(p, up) == sun.direction());
    lights.add(RectangleLight::facing({0.5f, -2, 0}, p, 0.1f, 0.1f, glm::vec3(1.0f)));  // dimmer: 0.0025 steradians
    CHECK(lights.towards_brightest(p, glm::vec3(0, -0.6f, 0.8f)) == sun.direction());
    lights.add(SphereLight({0.5f, 3, 0.1f}, 1, glm::vec3(10.0f)));
    const glm::vec3 to_sphere = lights.towards_brightest(p, glm::normalize(glm::vec3(0, 1, 1))).value();
    CHECK(glm::distance(p + 3.0f * to_sphere, glm::vec3(0.5f, 3, 0.1f)) < 1.1f);
    // Below the horizon, no light counts.
    CHECK_FALSE(lights.towards_brightest(p, -up));
    CHECK(glm::distance(lights.towards_brightest(p, glm::vec3(-0.6f, -0.8f, 0)).value(), glm::vec3(0, -1, 0)) <
          1e-4f);  // the rectangle
}

TEST_CASE("lights: points that are stratified in the square are so for each light") {
    // Two equal squares of light: an even grid of 32×16 points is an even grid of 16×16 on each.
    Lights lights;
    for (const float x : {-1.0f, 1.0f})
        lights.add(RectangleLight::facing({x, 0, 1}, {x, 0, 0}, 0.02f, 0.02f, glm::vec3(1.0f)));
    std::array<std::array<int, 16 * 16>, 2> hits{};
    for (int i = 0; i < 32; ++i)
        for (int j = 0; j < 16; ++j) {
            const auto s = lights.sample(glm::vec3{0, 0, 0},
                                         {(static_cast<float>(i) + 0.5f) / 32, (static_cast<float>(j) + 0.5f) / 16});
            REQUIRE(s);
            const glm::vec3 at = s->wi / s->wi.z;
            const float x = std::abs(at.x);
            const auto bin = [](float v) { return std::clamp(static_cast<int>(v * 16), 0, 15); };
            ++hits[at.x > 0][static_cast<std::size_t>(bin((x - 0.99f) / 0.02f) * 16 + bin((at.y + 0.01f) / 0.02f))];
        }
    for (const auto& light : hits) CHECK(std::count(light.begin(), light.end(), 1) > 200);
}

}  // namespace test_light_collection
