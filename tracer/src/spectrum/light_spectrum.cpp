#include "spectrum/light_spectrum.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "image/luminance.hpp"

namespace phasetree::tracer {

namespace {

// Between these D65 is known; a nanometre is finer than any of the points of D65 and of most lamps.
constexpr int first_nanometre = 380, last_nanometre = 780;

Spectrum relative_to_daylight(const Spectrum& power) {
    std::vector<Spectrum::Point> points;
    // Over the greatest, so that no float is too large or too small whatever the unit is.
    const double unit = power.greatest() > 0.0f ? static_cast<double>(power.greatest()) : 1.0;
    for (int nm = first_nanometre; nm <= last_nanometre; ++nm) {
        const auto at = static_cast<float>(nm);
        points.push_back({at, static_cast<float>(static_cast<double>(power.at(at)) / unit / daylight_at(nm))});
    }
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
    constexpr double second_radiation_constant = 1.438776877e7;  // nm K
    std::vector<Spectrum::Point> points;
    const auto exponent = [&](double nm) { return second_radiation_constant / (nm * static_cast<double>(kelvin)); };
    // Over the power at 780 nm, where what is not very hot shines most: no float is too small for the ratio.
    const double reference = exponent(last_nanometre);
    for (int nm = first_nanometre; nm <= last_nanometre; ++nm) {
        const double ratio =
            std::pow(last_nanometre / static_cast<double>(nm), 5) * std::expm1(reference) / std::expm1(exponent(nm));
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
