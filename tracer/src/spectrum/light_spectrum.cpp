#include "spectrum/light_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "image/luminance.hpp"
#include "phasetree/math/portable.hpp"
#include "spectrum/daylight.hpp"
#include "spectrum/planck.hpp"

namespace phasetree::tracer {

namespace {

// D65 is known between these. Steps of a nanometre are finer than the table of D65; narrow lines are spread over one or
// two steps.
constexpr int first_nanometre = 380, last_nanometre = 780;

Spectrum relative_to_daylight(const Spectrum& power) {
    std::vector<double> means;
    for (int nm = first_nanometre; nm < last_nanometre; ++nm) {
        const double middle = nm + 0.5;
        means.push_back(power.mean_around(middle) / daylight_at(middle));
    }
    // Dividing by the maximum keeps the numbers in the range of floats, whatever their unit.
    const double greatest = *std::ranges::max_element(means);
    std::vector<Spectrum::Point> points;
    for (std::size_t i = 0; i < means.size(); ++i)
        points.push_back({static_cast<float>(first_nanometre + static_cast<int>(i)) + 0.5f,
                          static_cast<float>(greatest > 0.0 ? means[i] / greatest : 0.0)});
    const float brightness = luminance(Spectrum(points).colour());
    for (Spectrum::Point& point : points) point.value = brightness > 0.0f ? point.value / brightness : 0.0f;
    return Spectrum(std::move(points));
}

}  // namespace

LightSpectrum::LightSpectrum(const Spectrum& power)
    : relative_(relative_to_daylight(power)), colour_(0.0f), visible_(relative_.greatest() > 0.0f) {
    const glm::vec3 mixed = glm::max(relative_.colour(), glm::vec3(0.0f));
    if (visible_) colour_ = mixed / luminance(mixed);
}

LightSpectrum LightSpectrum::of_temperature(float kelvin) {
    std::vector<Spectrum::Point> points;
    const auto exponent = [&](double nm) { return planck_exponent(nm, static_cast<double>(kelvin)); };
    // Dividing by the power at 780 nm keeps all numbers in the range of floats from 500 K on, the minimum in scene
    // files.
    const double reference = exponent(last_nanometre);
    for (int nm = first_nanometre; nm <= last_nanometre; ++nm) {
        const double ratio = std::pow(last_nanometre / static_cast<double>(nm), 5) * portable::expm1(reference) /
                             portable::expm1(exponent(nm));
        points.push_back({static_cast<float>(nm), static_cast<float>(ratio)});
    }
    return LightSpectrum(Spectrum(std::move(points)));
}

glm::vec3 LightSpectrum::light(const glm::vec3& rgb, const Wavelengths* wavelengths) const {
    const float brightness = luminance(rgb);
    if (wavelengths && wavelengths->is_spectral) return brightness * relative_.at(*wavelengths);
    return for_light(brightness * colour_, wavelengths);
}

}  // namespace phasetree::tracer
