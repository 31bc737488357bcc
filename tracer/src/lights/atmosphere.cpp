#include "lights/atmosphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phasetree::tracer {

namespace {

using glm::dvec3;
constexpr double half_turn = std::numbers::pi;

constexpr double ground_radius = 6360.0;
constexpr double top_radius = 6460.0;
constexpr double observer_radius = ground_radius + 0.05;
const double horizon_length = std::sqrt(top_radius * top_radius - ground_radius * ground_radius);

constexpr double air_scale_height = 8.0;
constexpr double aerosol_scale_height = 1.2;
constexpr double aerosol_albedo = 0.97;    // share of the aerosol's extinction that is scattering
constexpr double aerosol_asymmetry = 0.8;  // mean cosine of the scattering angle
const dvec3 air_scattering(5.802e-3, 13.558e-3, 33.1e-3);
const dvec3 ozone_absorption(0.650e-3, 1.881e-3, 0.085e-3);
const dvec3 wavelengths(0.680, 0.550, 0.440);  // micrometres

constexpr int transmittance_cosines = 128;
constexpr int transmittance_heights = 32;
constexpr int multiple_cosines = 32;
constexpr int multiple_heights = 16;

double air_phase(double cosine) {
    return 3.0 / (16.0 * half_turn) * (1.0 + cosine * cosine);
}

double aerosol_phase(double cosine) {
    constexpr double g = aerosol_asymmetry;
    constexpr double k = 3.0 / (8.0 * half_turn) * (1.0 - g * g) / (2.0 + g * g);
    return k * (1.0 + cosine * cosine) / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
}

// Distance from radius r, along a direction at `cosine` from the zenith, to the sphere of radius `sphere` ≥ r.
double distance_out(double r, double cosine, double sphere) {
    return -r * cosine + std::sqrt(std::max(0.0, r * r * (cosine * cosine - 1.0) + sphere * sphere));
}

bool meets_ground(double r, double cosine) {
    return cosine < 0.0 && r * r * (cosine * cosine - 1.0) + ground_radius * ground_radius >= 0.0;
}

double distance_to_ground(double r, double cosine) {
    return -r * cosine - std::sqrt(std::max(0.0, r * r * (cosine * cosine - 1.0) + ground_radius * ground_radius));
}

dvec3 interpolate(const std::vector<dvec3>& table, int width, int height, double x, double y) {
    const double px = std::clamp(x, 0.0, 1.0) * (width - 1);
    const double py = std::clamp(y, 0.0, 1.0) * (height - 1);
    const int column = std::min(static_cast<int>(px), width - 2);
    const int row = std::min(static_cast<int>(py), height - 2);
    const auto at = [&](int c, int r) { return table[static_cast<std::size_t>(r * width + c)]; };
    const double fx = px - column;
    const double fy = py - row;
    return (1.0 - fy) * ((1.0 - fx) * at(column, row) + fx * at(column + 1, row)) +
           fy * ((1.0 - fx) * at(column, row + 1) + fx * at(column + 1, row + 1));
}

}  // namespace

Atmosphere::Atmosphere(double turbidity, const dvec3& ground_albedo) : ground_albedo_(ground_albedo) {
    const double beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
    const dvec3 optical_depth = beta * glm::pow(wavelengths, dvec3(-1.3));
    aerosol_extinction_ = optical_depth / aerosol_scale_height;
    aerosol_scattering_ = aerosol_albedo * aerosol_extinction_;
    tabulate_transmittance();
    tabulate_multiple();
}

Atmosphere::Medium Atmosphere::medium(double radius) const {
    const double height = radius - ground_radius;
    const double aerosol_density = std::exp(-height / aerosol_scale_height);
    const double ozone_density = std::max(0.0, 1.0 - std::abs(height - 25.0) / 15.0);
    Medium m{};
    m.air = air_scattering * std::exp(-height / air_scale_height);
    m.aerosol = aerosol_scattering_ * aerosol_density;
    m.extinction = m.air + aerosol_extinction_ * aerosol_density + ozone_absorption * ozone_density;
    return m;
}

void Atmosphere::tabulate_transmittance() {
    transmittance_.resize(static_cast<std::size_t>(transmittance_cosines * transmittance_heights));
    for (int row = 0; row < transmittance_heights; ++row) {
        const double rho = horizon_length * row / (transmittance_heights - 1);
        const double r = std::sqrt(rho * rho + ground_radius * ground_radius);
        for (int column = 0; column < transmittance_cosines; ++column) {
            const double shortest = top_radius - r;
            const double longest = rho + horizon_length;
            const double d = shortest + (longest - shortest) * column / (transmittance_cosines - 1);
            const double cosine =
                d > 0.0 ? std::clamp((horizon_length * horizon_length - rho * rho - d * d) / (2.0 * r * d), -1.0, 1.0)
                        : 1.0;
            constexpr int steps = 64;
            dvec3 depth(0.0);
            for (int i = 0; i < steps; ++i) {
                // Quadratic spacing: the air is densest at the ray's start or, below the horizontal, not far from it.
                const double a = static_cast<double>(i) / steps;
                const double b = static_cast<double>(i + 1) / steps;
                const double t = d * 0.5 * (a * a + b * b);
                const double radius = std::sqrt(std::max(0.0, r * r + t * t + 2.0 * r * t * cosine));
                depth += medium(radius).extinction * (d * (b * b - a * a));
            }
            transmittance_[static_cast<std::size_t>(row * transmittance_cosines + column)] = glm::exp(-depth);
        }
    }
}

// To the top of the atmosphere, for rays that miss the ground.
dvec3 Atmosphere::transmittance(double radius, double cosine) const {
    const double r = std::clamp(radius, ground_radius, top_radius);
    const double rho = std::sqrt(r * r - ground_radius * ground_radius);
    const double shortest = top_radius - r;
    const double longest = rho + horizon_length;
    const double d = distance_out(r, cosine, top_radius);
    return interpolate(transmittance_, transmittance_cosines, transmittance_heights,
                       (d - shortest) / (longest - shortest), rho / horizon_length);
}

// Transmittance towards the sun, which sets gradually over its angular diameter.
dvec3 Atmosphere::sunlight(double radius, double cosine) const {
    const double r = std::clamp(radius, ground_radius, top_radius);
    const double sin_horizon = ground_radius / r;
    const double cos_horizon = -std::sqrt(std::max(0.0, 1.0 - sin_horizon * sin_horizon));
    constexpr double sun_radius = 0.004625;  // radians
    const double t = std::clamp((cosine - cos_horizon) / (2.0 * sun_radius * sin_horizon) + 0.5, 0.0, 1.0);
    if (t == 0.0) return dvec3(0.0);
    return t * t * (3.0 - 2.0 * t) * transmittance(r, std::max(cosine, cos_horizon));
}

Atmosphere::Scattered Atmosphere::scattered_once_isotropically(double radius, const dvec3& view,
                                                               const dvec3& to_sun) const {
    constexpr int steps = 20;
    const bool ground = meets_ground(radius, view.z);
    const double length = ground ? distance_to_ground(radius, view.z) : distance_out(radius, view.z, top_radius);
    const dvec3 start(0.0, 0.0, radius);
    Scattered result{dvec3(0.0), dvec3(0.0)};
    dvec3 through(1.0);
    for (int i = 0; i < steps; ++i) {
        const double step = length / steps;
        const dvec3 position = start + view * ((i + 0.5) * step);
        const double r = glm::length(position);
        const Medium m = medium(r);
        const dvec3 step_through = glm::exp(-m.extinction * step);
        const dvec3 scattering = m.air + m.aerosol;
        const dvec3 weight = through * scattering * (1.0 - step_through) / m.extinction;
        result.again += weight;
        result.radiance += weight * sunlight(r, glm::dot(position, to_sun) / r) / (4.0 * half_turn);
        through *= step_through;
    }
    if (ground) {
        const dvec3 up = glm::normalize(start + view * length);
        const double cosine = glm::dot(up, to_sun);
        if (cosine > 0.0)
            result.radiance += through * sunlight(ground_radius, cosine) * cosine * ground_albedo_ / half_turn;
    }
    return result;
}

void Atmosphere::tabulate_multiple() {
    multiple_.resize(static_cast<std::size_t>(multiple_heights * multiple_cosines));
    constexpr int directions = 8;
    for (int row = 0; row < multiple_heights; ++row) {
        const double height = static_cast<double>(row) / (multiple_heights - 1);
        const double radius = ground_radius + 0.01 + (top_radius - ground_radius - 0.02) * height * height;
        for (int column = 0; column < multiple_cosines; ++column) {
            const double sun_cosine = -1.0 + 2.0 * column / (multiple_cosines - 1);
            const dvec3 to_sun(0.0, std::sqrt(std::max(0.0, 1.0 - sun_cosine * sun_cosine)), sun_cosine);
            dvec3 second(0.0);
            dvec3 again(0.0);
            for (int i = 0; i < directions; ++i) {
                for (int j = 0; j < directions; ++j) {
                    const double z = 1.0 - 2.0 * (i + 0.5) / directions;
                    const double azimuth = half_turn * (j + 0.5) / directions;  // the other half is symmetric
                    const double s = std::sqrt(1.0 - z * z);
                    const dvec3 view(s * std::sin(azimuth), s * std::cos(azimuth), z);
                    const Scattered once = scattered_once_isotropically(radius, view, to_sun);
                    second += once.radiance / static_cast<double>(directions * directions);
                    again += once.again / static_cast<double>(directions * directions);
                }
            }
            multiple_[static_cast<std::size_t>(row * multiple_cosines + column)] = second / (1.0 - again);
        }
    }
}

dvec3 Atmosphere::multiple(double radius, double sun_cosine) const {
    const double height = (radius - ground_radius - 0.01) / (top_radius - ground_radius - 0.02);
    return interpolate(multiple_, multiple_cosines, multiple_heights, 0.5 + 0.5 * sun_cosine,
                       std::sqrt(std::max(0.0, height)));
}

std::vector<Atmosphere::Step> Atmosphere::path(double sin_elevation) const {
    constexpr int count = 48;
    const double length = distance_out(observer_radius, sin_elevation, top_radius);
    std::vector<Step> steps(count);
    dvec3 through(1.0);
    for (int i = 0; i < count; ++i) {
        // Quadratic spacing because the air is densest at the observer.
        const double a = static_cast<double>(i) / count;
        const double b = static_cast<double>(i + 1) / count;
        Step& step = steps[static_cast<std::size_t>(i)];
        step.distance = length * 0.5 * (a * a + b * b);
        step.radius = std::sqrt(observer_radius * observer_radius + step.distance * step.distance +
                                2.0 * observer_radius * step.distance * sin_elevation);
        const Medium m = medium(step.radius);
        const dvec3 step_through = glm::exp(-m.extinction * (length * (b * b - a * a)));
        // The integral of a source that is constant over the step, with the step's own extinction.
        const dvec3 weight = through * (1.0 - step_through) / glm::max(m.extinction, dvec3(1e-12));
        step.air = weight * m.air;
        step.aerosol = weight * m.aerosol;
        through *= step_through;
    }
    return steps;
}

dvec3 Atmosphere::sky(std::span<const Step> path, const dvec3& view, const dvec3& to_sun) const {
    const double cosine = glm::dot(view, to_sun);
    const double air = air_phase(cosine);
    const double aerosol = aerosol_phase(cosine);
    dvec3 radiance(0.0);
    for (const Step& step : path) {
        const double sun_cosine = (observer_radius * to_sun.z + step.distance * cosine) / step.radius;
        radiance += (step.air * air + step.aerosol * aerosol) * sunlight(step.radius, sun_cosine) +
                    (step.air + step.aerosol) * multiple(step.radius, sun_cosine);
    }
    return radiance;
}

dvec3 Atmosphere::sun_transmittance(double sin_elevation) const {
    return sunlight(observer_radius, sin_elevation);
}

}  // namespace phasetree::tracer
