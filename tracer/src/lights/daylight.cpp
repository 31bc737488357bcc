#include "lights/daylight.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lights/atmosphere.hpp"
#include "lights/check.hpp"
#include "lights/lat_long.hpp"

namespace phasetree::tracer {

namespace {

// The irradiance of the sun above the atmosphere, in the unit described in the header.
constexpr double sun_irradiance = 4.872;

constexpr int width = 512;
constexpr int height = 256;

}  // namespace

Daylight make_daylight(const DaylightParameters& parameters) {
    check_range(parameters.sun_elevation_degrees, -90.0f, 90.0f, "the sun's elevation in degrees");
    check_range(parameters.turbidity, 1.0f, 10.0f, "the sky's turbidity");
    check_colour(parameters.ground_albedo, "the ground's albedo");
    for (int i = 0; i < 3; ++i)
        check_range(parameters.ground_albedo[i], 0.0f, 1.0f, "each part of the ground's albedo");
    check_range(parameters.intensity, 0.0f, 1e30f, "the sky's intensity");
    check_range(parameters.sun_azimuth_degrees, -1e6f, 1e6f, "the sun's azimuth in degrees");

    const glm::dvec3 albedo(parameters.ground_albedo);
    const Atmosphere atmosphere(parameters.turbidity, albedo);
    // Tabulated with the sun at azimuth 0, then rotated. Left and right are symmetric.
    const glm::dvec3 to_sun(direction_of_degrees(0.0f, parameters.sun_elevation_degrees));
    const double unit = sun_irradiance * static_cast<double>(parameters.intensity);

    std::vector<glm::vec3> pixels(static_cast<std::size_t>(width * height));
    const auto set = [&](int column, int row, const glm::dvec3& radiance) {
        pixels[static_cast<std::size_t>(row * width + column)] = radiance;
        pixels[static_cast<std::size_t>(row * width + width - 1 - column)] = radiance;
    };
    glm::dvec3 sky_irradiance(0.0);
    for (int row = 0; row < height / 2; ++row) {
        const double theta = std::numbers::pi * (row + 0.5) / height;
        const auto path = atmosphere.path(std::cos(theta));
        for (int column = 0; column < width / 2; ++column) {
            const double azimuth = 2.0 * std::numbers::pi * ((column + 0.5) / width - 0.5);
            const glm::dvec3 view(std::sin(theta) * std::sin(azimuth), std::sin(theta) * std::cos(azimuth),
                                  std::cos(theta));
            const glm::dvec3 radiance = unit * atmosphere.sky(path, view, to_sun);
            set(column, row, radiance);
            sky_irradiance += 2.0 * radiance * std::cos(theta) * std::sin(theta);
        }
    }
    sky_irradiance *= (std::numbers::pi / height) * (2.0 * std::numbers::pi / width);

    const glm::dvec3 sun = unit * atmosphere.sun_transmittance(to_sun.z);
    const glm::dvec3 ground = albedo / std::numbers::pi * (sky_irradiance + sun * std::max(0.0, to_sun.z));
    for (int row = height / 2; row < height; ++row) {
        constexpr double haze_degrees = 1.5;
        const double degrees_below = 180.0 * (row + 0.5) / height - 90.0;
        const double haze = std::exp(-degrees_below / haze_degrees);
        for (int column = 0; column < width / 2; ++column) {
            const glm::dvec3 horizon(pixels[static_cast<std::size_t>((height / 2 - 1) * width + column)]);
            set(column, row, glm::mix(ground, horizon, haze));
        }
    }
    const glm::vec3 towards = direction_of_degrees(parameters.sun_azimuth_degrees, parameters.sun_elevation_degrees);
    return {ImageEnvironment(width, height, std::move(pixels), parameters.sun_azimuth_degrees),
            Sun(towards, glm::vec3(sun), parameters.sun_angular_diameter_degrees)};
}

}  // namespace phasetree::tracer
