// The interior medium of a clear material, from what a scene file says of it.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "image/luminance.hpp"
#include "media/measured.hpp"
#include "scene/material_kinds.hpp"

namespace phasetree::tracer {

namespace {

using P = ClearParameters;

// Refuses a second way to say the same.
void either(bool first, bool second, const char* key, const char* other) {
    if (first && second)
        throw ParameterError(key, fmt::format("\"{}\" and \"{}\" say the same; give one of them", key, other),
                             ParameterError::Place::key);
}

// That this is of no use without that.
void needs(bool has, bool other, const char* key, const char* wanted) {
    if (has && !other)
        throw ParameterError(key, fmt::format("\"{}\" is of no use without \"{}\"", key, wanted),
                             ParameterError::Place::key);
}

void check(const P& p) {
    either(p.color.has_value(), p.absorption.has_value(), "color", "absorption");
    either(p.absorption_spectrum != nullptr, p.absorption.has_value(), "absorption_spectrum", "absorption");
    either(p.absorption_spectrum != nullptr, p.color.has_value(), "absorption_spectrum", "color");
    either(p.absorption_spectrum != nullptr, p.medium.has_value(), "absorption_spectrum", "medium");
    either(p.absorption_spectrum != nullptr, p.albedo.has_value(), "absorption_spectrum", "albedo");
    either(p.medium.has_value(), p.absorption.has_value(), "medium", "absorption");
    either(p.medium.has_value(), p.color.has_value(), "medium", "color");
    either(p.medium.has_value(), p.scattering.has_value(), "medium", "scattering");
    either(p.medium.has_value(), p.albedo.has_value(), "medium", "albedo");
    either(p.albedo.has_value(), p.absorption.has_value(), "albedo", "absorption");
    either(p.albedo.has_value(), p.color.has_value(), "albedo", "color");
    either(p.albedo.has_value(), p.scattering.has_value(), "albedo", "scattering");
    needs(p.albedo.has_value(), p.mean_free_path.has_value(), "albedo", "mean_free_path");
    needs(p.mean_free_path.has_value(), p.albedo.has_value(), "mean_free_path", "albedo");
    needs(p.medium.has_value(), p.scale.has_value(), "medium", "scale");
    needs(p.scale.has_value(), p.medium.has_value(), "scale", "medium");
    const bool is_scattering = p.scattering || p.albedo || p.medium;
    needs(p.anisotropy.has_value(), is_scattering, "anisotropy", "scattering");
    const bool attenuates = is_scattering || p.absorption || p.absorption_spectrum || p.color;
    either(p.density_grid.has_value(), p.density.has_value(), "density_grid", "density");
    needs(p.density.has_value(), attenuates, "density", "scattering\" or \"absorption");
    needs(p.density_grid.has_value(), attenuates, "density_grid", "scattering\" or \"absorption");
    needs(p.emission_spectrum != nullptr, p.emission.has_value(), "emission_spectrum", "emission");
    either(p.temperature_grid.has_value(), p.emission_spectrum != nullptr, "temperature_grid", "emission_spectrum");
    needs(p.temperature_grid.has_value(), p.emission.has_value(), "temperature_grid", "emission");
    needs(p.temperature_grid.has_value(), p.density || p.density_grid, "temperature_grid",
          "density_grid\" or \"density");
    needs(p.density_depth.has_value(), p.density.has_value(), "density_depth", "density");
    needs(p.density.has_value(), p.density_depth.has_value(), "density", "density_depth");
}

// Absorption, scattering and emission beyond these would make infinities of products.
constexpr float most_per_metre = 1e15f, brightest = 1e25f;

// None where nothing is hot at all.
std::optional<Heat> heat_of(const Voxels& temperatures, float reference) {
    constexpr float hottest = 1e5f, coldest = 100;
    const float kelvin = temperatures.greatest();
    const bool is_no_kelvin = kelvin > 0 && kelvin < coldest && temperatures.factor == 1;
    if (!(kelvin <= hottest) || is_no_kelvin)
        throw ParameterError("temperature_grid",
                             fmt::format("its greatest temperature would be {:.4g} K; \"factor\" makes kelvin of the "
                                         "numbers",
                                         kelvin));
    if (!(kelvin > 0)) return std::nullopt;
    return Heat(*temperatures.shares, kelvin, reference);
}

// Of what is as dense as the voxels are at most.
ScatteringCoefficients densest(const ScatteringCoefficients& coefficients, float density) {
    const ScatteringCoefficients c = coefficients.times(density);
    const glm::vec3 emission = c.emission;
    if (!(c.greatest_extinction() <= most_per_metre) ||
        !(std::max({emission.x, emission.y, emission.z}) <= most_per_metre))
        throw ParameterError(
            "density_grid", fmt::format("where its numbers, by their \"factor\", are {:.4g}, absorption, scattering or "
                                        "emission would be beyond 10¹⁵ per metre",
                                        density));
    return c;
}

Absorption absorption_of(const P& p) {
    if (p.absorption_spectrum) return Absorption::of(p.absorption_spectrum);
    if (p.color) return Absorption::left_after(*p.color, p.color_distance);
    return p.absorption.value_or(glm::vec3(0.0f));
}

}  // namespace

Medium ClearParameters::interior() const {
    check(*this);
    ScatteringCoefficients c{.absorption = absorption_of(*this),
                             .scattering = scattering.value_or(glm::vec3(0.0f)),
                             .emission = emission.value_or(glm::vec3(0.0f)),
                             .emission_spectrum = emission_spectrum,
                             .phase_function = HenyeyGreenstein(anisotropy.value_or(0.0f))};
    if (albedo) {
        c.scattering = *albedo / *mean_free_path;
        c.absorption = (1.0f - *albedo) / *mean_free_path;
    }
    if (medium) {
        const MeasuredMedium measured = find_measured_medium(*medium).value();
        c.scattering = measured.reduced_scattering * (*scale / (1.0f - c.phase_function.g()));
        c.absorption = measured.absorption * *scale;
    }
    // By wavelength a medium may lose nothing here and there.
    const bool has_spectrum = absorption_spectrum || emission_spectrum || temperature_grid;
    const glm::vec3 extinction = has_spectrum ? glm::vec3(c.greatest_extinction()) : c.extinction();
    for (int i = 0; i < 3; ++i)
        if (c.emission[i] > 0.0f && !(extinction[i] > 0.0f))
            throw ParameterError("emission",
                                 "\"emission\" needs absorption or scattering in the same channel: without "
                                 "any, light would grow without end along a ray");
    std::optional<Heat> heat;
    if (temperature_grid) {
        heat = heat_of(*temperature_grid, emission_temperature);
        if (!heat) c.emission = glm::vec3(0.0f);
        if (heat && !(luminance(c.emission) * heat->luminance(1) <= brightest))
            throw ParameterError(
                "temperature_grid",
                fmt::format("where it is hottest, {:.4g} K, the medium would shine more than 10²⁵; the "
                            "emission is that at {:.4g} K",
                            temperature_grid->greatest(), emission_temperature));
        c.emission_spectrum =
            std::make_shared<const LightSpectrum>(LightSpectrum::of_temperature(emission_temperature));
    }
    if (density) return VaryingMedium(c, FieldDensity(*density, *density_depth), heat);
    if (density_grid) return VaryingMedium(densest(c, density_grid->greatest()), *density_grid->shares, heat);
    if (c.scatters() || c.emission != glm::vec3(0.0f)) return HomogeneousMedium(c);
    return AbsorbingMedium{c.absorption};
}

std::vector<std::string_view> names_of_media() {
    std::vector<std::string_view> names;
    for (const MeasuredMedium& medium : measured_media()) names.push_back(medium.name);
    return names;
}

}  // namespace phasetree::tracer
