#include "media/heat.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "image/luminance.hpp"
#include "spectrum/planck.hpp"

namespace phasetree::tracer {

namespace {

// The number of steps; light is interpolated linearly between them. For greatest temperatures from 200 to 100,000 K,
// the error is at most 0.15 % where the light is brighter than a thousandth of the hottest point's emission.
constexpr std::size_t steps = 1024;

std::vector<glm::vec3> colours_up_to(float greatest, float reference, const LightSpectrum& at_reference) {
    std::vector<glm::vec3> colours(steps + 1, glm::vec3(0.0f));
    for (std::size_t i = 1; i <= steps; ++i) {
        const double temperature = static_cast<double>(greatest) * static_cast<double>(i) / steps;
        const glm::vec3 mixed(colour_of([&](double nm) {
            return static_cast<double>(at_reference.relative_at(static_cast<float>(nm))) *
                   planck_ratio(nm, temperature, static_cast<double>(reference));
        }));
        // A colour outside the gamut is replaced by the nearest one inside, with the same luminance.
        const glm::vec3 positive = glm::max(mixed, glm::vec3(0.0f));
        const float brightness = tracer::luminance(positive);
        if (brightness > 0.0f) colours[i] = positive * (std::max(tracer::luminance(mixed), 0.0f) / brightness);
    }
    return colours;
}

}  // namespace

Heat::Heat(const VoxelDensity& shares, float greatest, float reference)
    : shares_(shares),
      greatest_(greatest),
      reference_(reference),
      spectrum_(std::make_shared<const LightSpectrum>(LightSpectrum::of_temperature(reference))),
      colours_(std::make_shared<const std::vector<glm::vec3>>(colours_up_to(greatest, reference, *spectrum_))) {}

glm::vec3 Heat::colour(float share) const {
    const float at = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(steps);
    const std::size_t i = std::min(static_cast<std::size_t>(at), steps - 1);
    return glm::mix((*colours_)[i], (*colours_)[i + 1], at - static_cast<float>(i));
}

float Heat::luminance(float share) const {
    return tracer::luminance(colour(share));
}

glm::vec3 Heat::light(float share, float luminance_at_reference, const Wavelengths* wavelengths) const {
    if (!wavelengths || !wavelengths->is_spectral)
        return for_light(luminance_at_reference * colour(share), wavelengths);
    const double kelvin = static_cast<double>(share) * static_cast<double>(greatest_);
    glm::vec3 light;
    for (int i = 0; i < 3; ++i) {
        const float nanometres = wavelengths->nanometres[i];
        light[i] =
            luminance_at_reference * spectrum_->relative_at(nanometres) *
            static_cast<float>(planck_ratio(static_cast<double>(nanometres), kelvin, static_cast<double>(reference_)));
    }
    return light;
}

}  // namespace phasetree::tracer
