// The procedural sky and the sun's disk.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "image/luminance.hpp"
#include "light_checks.hpp"
#include "lights/daylight.hpp"
#include "lights/sun.hpp"
#include "phasetree/model/preparation_watch.hpp"

namespace test_light_daylight {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

constexpr double half_turn = std::numbers::pi;

Daylight daylight_at(float elevation, float turbidity = 3.0f) {
    DaylightParameters parameters;
    parameters.sun_elevation_degrees = elevation;
    parameters.sun_azimuth_degrees = 45.0f;
    parameters.turbidity = turbidity;
    return make_daylight(parameters);
}

double level_irradiance(const ImageEnvironment& sky) {
    return sum_of(lat_long_probabilities(1, 1, 256, [&](const glm::vec3& w) {
        return static_cast<double>(luminance(sky.radiance(w)) * std::max(0.0f, w.z));
    }));
}

}  // namespace

TEST_CASE("sun: density, samples and irradiance at any size") {
    for (const float diameter : {0.05f, 0.53f, 5.0f, 90.0f}) {
        CAPTURE(diameter);
        const glm::vec3 towards = glm::normalize(glm::vec3(0.48f, -0.64f, 0.6f));
        const Sun sun(2.0f * towards, glm::vec3(3.0f), diameter);
        const double radius = 0.5 * diameter * half_turn / 180.0;
        const double height = 2.0 * std::pow(std::sin(0.5 * radius), 2.0);
        const double solid_angle = 2.0 * half_turn * height;
        CHECK(sun.pdf(towards) * solid_angle == doctest::Approx(1.0).epsilon(1e-5));
        CHECK(sun.fluence() == doctest::Approx(luminance(sun.radiance(towards)) * solid_angle).epsilon(1e-5));

        const std::vector<double> probability(ConeBins::count, sun.pdf(towards) * solid_angle / ConeBins::count);
        check_directions(
            probability, [&](const glm::vec2& u) { return std::optional(sun.sample(u)->direction); },
            ConeBins(glm::dvec3(sun.direction()), height));

        // E = L π sin²α cos θ = E⊥ cos θ while the whole disk is above the surface.
        const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.9f, 0.5f));
        const double cosine = glm::dot(normal, towards);
        CHECK(std::acos(cosine) + radius < 0.5 * half_turn);
        check(estimator_test(3.0 * cosine, 400000, [&](Uniform& random) {
            const auto s = sun.sample(random.two());
            return static_cast<double>(sun.radiance(s->direction).x * glm::dot(normal, s->direction) / s->pdf);
        }));
    }
}

// A direction sampled in the disk is rounded to floats, so it may lie slightly outside a small disk.
TEST_CASE("sun: of a small one no light is lost") {
    Uniform random(77);
    for (const float diameter : {1e-30f, 1e-6f, 1e-4f, 1e-3f, 0.01f, 0.1f, 0.53f}) {
        CAPTURE(diameter);
        for (int axis = 0; axis < 50; ++axis) {
            const glm::vec2 u = random.two();
            const glm::vec3 towards = direction_of(2.0 * half_turn * u.x, 2.0 * u.y - 1.0);
            const Sun sun(towards, glm::vec3(3.0f), diameter);
            double irradiance = 0;
            constexpr int samples = 2000;
            for (int i = 0; i < samples; ++i) {
                const auto s = sun.sample(random.two());
                const float radiance = sun.radiance(s->direction).x;
                REQUIRE(radiance > 0.0f);
                REQUIRE(sun.pdf(s->direction) == s->pdf);
                irradiance += static_cast<double>(radiance) / static_cast<double>(s->pdf) / samples;
            }
            // The tolerance allows for cos θ, which varies over the disk.
            REQUIRE(irradiance == doctest::Approx(3.0).epsilon(3e-5));
        }
    }
    CHECK_THROWS_AS(Sun({0, 0, 1}, glm::vec3(3e38f)), std::invalid_argument);
}

TEST_CASE("sun: the radiance and the density end together") {
    const Sun sun({0.0f, 0.0f, 1.0f}, glm::vec3(1.0f), 2.0f);
    for (const double degrees : {0.0, 0.5, 0.99, 1.01, 2.0, 90.0, 180.0}) {
        const glm::vec3 w = direction_of(1.0, std::cos(degrees * half_turn / 180.0));
        CHECK((sun.radiance(w).x > 0.0f) == (degrees < 1.0));
        CHECK((sun.pdf(w) > 0.0f) == (degrees < 1.0));
    }
    CHECK_THROWS_AS(Sun({0, 0, 0}, glm::vec3(1.0f)), std::invalid_argument);
    CHECK_THROWS_AS(Sun({0, 0, 1}, glm::vec3(1.0f), 0.0f), std::invalid_argument);
    CHECK_THROWS_AS(Sun({0, 0, 1}, glm::vec3(1.0f), 200.0f), std::invalid_argument);
}

TEST_CASE("sky: the estimator equals the integral") {
    const Daylight day = daylight_at(30.0f);
    check(estimator_test(level_irradiance(day.sky), 1000000, [&](Uniform& random) {
        const auto s = day.sky.sample(random.two());
        const float cosine = std::max(0.0f, s->direction.z);
        return static_cast<double>(luminance(day.sky.radiance(s->direction)) * cosine / s->pdf);
    }));
}

TEST_CASE("daylight: the unit, white ground under a sun 45° high has luminance 1") {
    const Daylight day = daylight_at(45.0f);
    const double sun = luminance(day.sun.radiance(day.sun.direction())) * half_turn *
                       std::pow(std::sin(0.5 * 0.53 * half_turn / 180.0), 2.0) * day.sun.direction().z;
    CHECK((level_irradiance(day.sky) + sun) / half_turn == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE("daylight: colours and directions one expects of a clear day") {
    const Daylight noon = daylight_at(60.0f);
    const Daylight evening = daylight_at(5.0f);
    const glm::vec3 north_sky = noon.sky.radiance(direction_of_degrees(225.0f, 60.0f));
    CHECK(north_sky.b > 1.5f * north_sky.r);
    const glm::vec3 low_sun = evening.sun.radiance(evening.sun.direction());
    CHECK(low_sun.r > 2.0f * low_sun.b);
    const glm::vec3 high_sun = noon.sun.radiance(noon.sun.direction());
    CHECK(high_sun.r < 1.6f * high_sun.b);
    CHECK(glm::length(noon.sun.direction() - direction_of_degrees(45.0f, 60.0f)) < 1e-6f);
    CHECK(luminance(evening.sky.radiance(direction_of_degrees(45.0f, 6.0f))) >
          5.0f * luminance(evening.sky.radiance(direction_of_degrees(225.0f, 6.0f))));
    // Haze moves light from the sun to the sky.
    const Daylight clear = daylight_at(45.0f, 2.0f);
    const Daylight hazy = daylight_at(45.0f, 8.0f);
    CHECK(luminance(hazy.sun.radiance(hazy.sun.direction())) < luminance(clear.sun.radiance(clear.sun.direction())));
    CHECK(level_irradiance(hazy.sky) > level_irradiance(clear.sky));
}

TEST_CASE("daylight: finite, never negative, without steps, from night to noon") {
    for (const float elevation : {-90.0f, -8.0f, -1.0f, 0.0f, 0.3f, 10.0f, 90.0f}) {
        for (const float turbidity : {1.0f, 10.0f}) {
            CAPTURE(elevation);
            CAPTURE(turbidity);
            const Daylight day = daylight_at(elevation, turbidity);
            glm::vec3 largest(0.0f);
            for (int degrees = -90; degrees <= 90; ++degrees) {
                largest = glm::max(largest, day.sky.radiance(direction_of_degrees(45.0f, static_cast<float>(degrees))));
            }
            bool usable = true;
            float largest_step = 0.0f;
            for (int azimuth = 0; azimuth < 360; azimuth += 5) {
                glm::vec3 previous = day.sky.radiance({0.0f, 0.0f, 1.0f});
                for (int tenth = 899; tenth >= 0; --tenth) {
                    const glm::vec3 seen = day.sky.radiance(
                        direction_of_degrees(static_cast<float>(azimuth), 0.1f * static_cast<float>(tenth)));
                    for (int c = 0; c < 3; ++c) {
                        usable = usable && std::isfinite(seen[c]) && seen[c] >= 0.0f;
                        if (largest[c] > 0.0f) {
                            largest_step = std::max(largest_step, std::abs(seen[c] - previous[c]) / largest[c]);
                        }
                    }
                    previous = seen;
                }
            }
            CHECK(usable);
            // Near a low sun the sky falls off within a degree, so a tenth of the brightness corresponds to a tenth of
            // a degree.
            CHECK(largest_step < 0.1f);
            CHECK((luminance(day.sun.radiance(day.sun.direction())) > 0.0f) == (elevation > -0.5f));
        }
    }
    DaylightParameters parameters;
    parameters.turbidity = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(make_daylight(parameters), std::invalid_argument);
}

TEST_CASE("sky: a known table is found again, and only if all that it depends on is the same") {
    const auto seen = [](const DaylightParameters& parameters) {
        return make_daylight(parameters).sky.radiance(glm::normalize(glm::vec3(0.1f, 0.4f, 0.5f)));
    };
    const DaylightParameters parameters{.sun_elevation_degrees = 30.0f};
    std::vector<DaylightParameters> others(5, parameters);
    others[0].sun_elevation_degrees = 31.0f;
    others[1].sun_azimuth_degrees = 90.0f;
    others[2].turbidity = 4.0f;
    others[3].ground_albedo = glm::vec3(0.3f, 0.3f, 0.9f);
    others[4].intensity = 2.0f;
    const glm::vec3 first = seen(parameters);
    for (const DaylightParameters& other : others) CHECK(seen(other) != first);

    int polls = 0;
    const PreparationWatch watch({.cancelled = [&] { return ++polls, false; }, .progress = {}});
    const Daylight kept = make_daylight(parameters);
    CHECK(polls > 1);  // the table was dropped for later ones
    polls = 0;
    CHECK(seen(parameters) == first);
    CHECK(polls == 0);
    for (const DaylightParameters& other : others) (void)seen(other);
    polls = 0;
    (void)seen(parameters);  // which is still used
    CHECK(polls == 0);
}

TEST_CASE("sky: making the table can be cancelled") {
    int polls = 0;
    const PreparationWatch watch({.cancelled = [&] { return ++polls > 3; }, .progress = {}});
    CHECK_THROWS_AS(make_daylight({.sun_elevation_degrees = 7.0f}), PreparationCancelled);
}

}  // namespace test_light_daylight
