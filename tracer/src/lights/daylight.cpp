#include "lights/daylight.hpp"

#include <array>
#include <cmath>
#include <list>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "lights/atmosphere.hpp"
#include "lights/check.hpp"
#include "lights/lat_long.hpp"
#include "phasetree/model/poll_preparation.hpp"

namespace phasetree::tracer {

namespace {

// The irradiance of the sun above the atmosphere, in the unit described in the header.
constexpr double sun_irradiance = 4.872;

constexpr int width = 512;
constexpr int height = 256;

// The sky with the sun at azimuth 0.
struct Table {
    std::shared_ptr<const EnvironmentImage> image;
    glm::vec3 sun;
};

// Recently tabulated skies. A table takes half a second, and while a scene is edited it is read after every step.
class RecentTables {
  public:
    using Key = std::array<float, 6>;

    static Key key_of(const DaylightParameters& p) {
        return {p.sun_elevation_degrees, p.turbidity,       p.ground_albedo.x,
                p.ground_albedo.y,       p.ground_albedo.z, p.intensity};
    }
    template <class Tabulate>
    Table find_or(const Key& key, Tabulate&& tabulate) {
        {
            const std::lock_guard lock(mutex_);
            tables_.remove_if([](const Known& known) { return known.image.expired(); });
            for (const Known& known : tables_)
                if (known.key == key)
                    if (auto image = known.image.lock()) return {std::move(image), known.sun};
        }
        Table table = tabulate();
        const std::lock_guard lock(mutex_);
        tables_.push_back({key, table.image, table.sun});
        last_.push_back(table.image);
        if (last_.size() > most_unused) last_.pop_front();
        return table;
    }

  private:
    // These stay even if no scene uses them. Others stay as long as a scene does.
    static constexpr std::size_t most_unused = 2;

    struct Known {
        Key key;
        std::weak_ptr<const EnvironmentImage> image;
        glm::vec3 sun;
    };
    std::mutex mutex_;
    std::list<Known> tables_;
    std::list<std::shared_ptr<const EnvironmentImage>> last_;
};

Table tabulated(const DaylightParameters& parameters) {
    const glm::dvec3 albedo(parameters.ground_albedo);
    poll_preparation();
    const Atmosphere atmosphere(parameters.turbidity, albedo);
    // Left and right are symmetric.
    const glm::dvec3 to_sun(direction_of_degrees(0.0f, parameters.sun_elevation_degrees));
    const double unit = sun_irradiance * static_cast<double>(parameters.intensity);

    std::vector<glm::vec3> pixels(static_cast<std::size_t>(width * height));
    const auto set = [&](int column, int row, const glm::dvec3& radiance) {
        pixels[static_cast<std::size_t>(row * width + column)] = radiance;
        pixels[static_cast<std::size_t>(row * width + width - 1 - column)] = radiance;
    };
    glm::dvec3 sky_irradiance(0.0);
    for (int row = 0; row < height / 2; ++row) {
        poll_preparation();
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
    return {std::make_shared<const EnvironmentImage>(width, height, std::move(pixels)), glm::vec3(sun)};
}

}  // namespace

Daylight make_daylight(const DaylightParameters& parameters) {
    check_range(parameters.sun_elevation_degrees, -90.0f, 90.0f, "the sun's elevation in degrees");
    check_range(parameters.turbidity, 1.0f, 10.0f, "the sky's turbidity");
    check_colour(parameters.ground_albedo, "the ground's albedo");
    for (int i = 0; i < 3; ++i)
        check_range(parameters.ground_albedo[i], 0.0f, 1.0f, "each part of the ground's albedo");
    check_range(parameters.intensity, 0.0f, 1e30f, "the sky's intensity");
    check_range(parameters.sun_azimuth_degrees, -1e6f, 1e6f, "the sun's azimuth in degrees");

    static RecentTables recent;
    const Table table = recent.find_or(RecentTables::key_of(parameters), [&] { return tabulated(parameters); });
    const glm::vec3 towards = direction_of_degrees(parameters.sun_azimuth_degrees, parameters.sun_elevation_degrees);
    return {ImageEnvironment(table.image, parameters.sun_azimuth_degrees),
            Sun(towards, table.sun, parameters.sun_angular_diameter_degrees)};
}

}  // namespace phasetree::tracer
