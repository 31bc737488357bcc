// The medium inside a clear material, from its parameters in a scene file.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "media/measured.hpp"
#include "scene/material_kinds.hpp"
#include "scene/parameter_relations.hpp"

namespace phasetree::tracer {

namespace {

using P = ClearParameters;

// Returns nullopt if all temperatures are 0.
std::optional<Heat> heat_of(const Voxels& temperatures, float reference) {
    constexpr float hottest = 1e5f, coldest = 100;
    const float greatest = temperatures.greatest_number();
    const bool looks_unscaled = greatest > 0 && greatest < coldest && temperatures.factor == 1;
    if (!(greatest <= hottest) || looks_unscaled)
        throw ParameterError(
            "temperature_grid",
            fmt::format("its highest temperature would be {:.4g} K; use \"factor\" to convert its numbers to kelvin",
                        greatest));
    if (!(greatest > 0)) return std::nullopt;
    return Heat(*temperatures.shares, greatest, reference);
}

// Throws if products with the coefficients of a varying medium would overflow where it is densest and hottest.
void check_size(const ScatteringCoefficients& c, const std::optional<Heat>& heat, const char* key) {
    constexpr float most_extinction = 1e15f, most_emission = 1e25f;
    const float emission =
        std::max({c.emission.x, c.emission.y, c.emission.z}) * (heat ? std::max(heat->luminance(1), 1.0f) : 1.0f);
    if (!(c.greatest_extinction() <= most_extinction))
        throw ParameterError(key, "the absorption and scattering of the densest part exceed 10¹⁵ per metre");
    if (!(emission <= most_emission))
        throw ParameterError(
            key, fmt::format("the emission of the densest{} part exceeds 10²⁵ per metre", heat ? " and hottest" : ""));
}

Absorption absorption_of(const P& p) {
    if (p.absorption_spectrum) return Absorption::of(p.absorption_spectrum);
    if (p.color) return Absorption::left_after(*p.color, p.color_distance);
    return p.absorption.value_or(glm::vec3(0.0f));
}

}  // namespace

Medium ClearParameters::interior() const {
    check_relations_of(*this, relations_of_clear());
    ScatteringCoefficients c{.absorption = absorption_of(*this),
                             .scattering = scattering.value_or(glm::vec3(0.0f)),
                             .emission = emission.value_or(glm::vec3(0.0f)),
                             .emission_spectrum = emission_spectrum,
                             .phase_function = phase_function.value_or(HenyeyGreenstein(anisotropy.value_or(0.0f)))};
    if (albedo) {
        c.scattering = *albedo / *mean_free_path;
        c.absorption = (1.0f - *albedo) / *mean_free_path;
    }
    if (medium) {
        const MeasuredMedium measured = find_measured_medium(*medium).value();
        c.scattering = measured.reduced_scattering * (*scale / (1.0f - c.phase_function.mean_cosine()));
        c.absorption = measured.absorption * *scale;
    }
    // Wavelengths may have extinction where the colour has none.
    const bool has_spectrum = absorption_spectrum || emission_spectrum || temperature_grid;
    const glm::vec3 extinction = has_spectrum ? glm::vec3(c.greatest_extinction()) : c.extinction();
    for (int i = 0; i < 3; ++i)
        if (c.emission[i] > 0.0f && !(extinction[i] > 0.0f))
            throw ParameterError("emission",
                                 "\"emission\" requires absorption or scattering in the same channel; otherwise "
                                 "radiance would grow without limit along a ray");
    const auto is_unread = [](const std::optional<Voxels>& voxels) { return voxels && !voxels->shares; };
    if (is_unread(density_grid) || is_unread(temperature_grid)) return AbsorbingMedium{};
    if (density || density_grid) {
        std::optional<Heat> heat;
        if (temperature_grid) {
            heat = heat_of(*temperature_grid, emission_temperature);
            if (!heat) c.emission = glm::vec3(0.0f);
        }
        if (density_grid) c = c.times(density_grid->greatest_number());
        check_size(c, heat, density_grid ? "density_grid" : "density");
        if (density_grid) return VaryingMedium(c, *density_grid->shares, heat);
        return VaryingMedium(c, FieldDensity(*density, *density_depth), heat);
    }
    if (c.scatters() || c.emission != glm::vec3(0.0f)) return HomogeneousMedium(c);
    return AbsorbingMedium{c.absorption};
}

std::vector<std::string_view> names_of_media() {
    std::vector<std::string_view> names;
    for (const MeasuredMedium& medium : measured_media()) names.push_back(medium.name);
    return names;
}

}  // namespace phasetree::tracer
