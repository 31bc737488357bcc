#include "media/heat.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "image/luminance.hpp"
#include "spectrum/daylight.hpp"
#include "spectrum/planck.hpp"

namespace phasetree::tracer {

namespace {

// Between two of so many steps light is interpolated. It is wrong by less than a thousandth where it is brighter than a
// thousandth of what the hottest place shines.
constexpr std::size_t steps = 1024;

std::vector<glm::vec3> colours_up_to(float hottest, float reference) {
    const LightSpectrum at_reference = LightSpectrum::of_temperature(reference);
    std::vector<glm::vec3> colours(steps + 1, glm::vec3(0.0f));
    for (std::size_t i = 1; i <= steps; ++i) {
        const double temperature = static_cast<double>(hottest) * static_cast<double>(i) / steps;
        const glm::vec3 mixed(colour_of([&](double nm) {
            return static_cast<double>(at_reference.relative_at(static_cast<float>(nm))) *
                   planck_ratio(nm, temperature, static_cast<double>(reference));
        }));
        // What red, green and blue cannot mix is cut off, and its luminance kept, as light of one temperature does.
        const glm::vec3 positive = glm::max(mixed, glm::vec3(0.0f));
        const float brightness = tracer::luminance(positive);
        if (brightness > 0.0f) colours[i] = positive * (std::max(tracer::luminance(mixed), 0.0f) / brightness);
    }
    return colours;
}

}  // namespace

Heat::Heat(const VoxelDensity& shares, float hottest, float reference)
    : shares_(shares),
      hottest_(hottest),
      reference_(reference),
      colours_(std::make_shared<const std::vector<glm::vec3>>(colours_up_to(hottest, reference))) {}

glm::vec3 Heat::colour(float share) const {
    const float at = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(steps);
    const std::size_t i = std::min(static_cast<std::size_t>(at), steps - 1);
    return glm::mix((*colours_)[i], (*colours_)[i + 1], at - static_cast<float>(i));
}

float Heat::luminance(float share) const {
    return tracer::luminance(colour(share));
}

glm::vec3 Heat::light(float share, const glm::vec3& light_at_reference, float luminance_at_reference,
                      const Wavelengths* wavelengths) const {
    if (!wavelengths || !wavelengths->is_spectral)
        return for_light(luminance_at_reference * colour(share), wavelengths);
    const double kelvin = static_cast<double>(share) * static_cast<double>(hottest_);
    glm::vec3 light;
    for (int i = 0; i < 3; ++i) {
        const auto nanometres = static_cast<double>(wavelengths->nanometres[i]);
        light[i] = light_at_reference[i] *
                   static_cast<float>(planck_ratio(nanometres, kelvin, static_cast<double>(reference_)));
    }
    return light;
}

}  // namespace phasetree::tracer
