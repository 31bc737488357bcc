#include "media/absorption.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

Absorption Absorption::of(SharedSpectrum spectrum) {
    constexpr float darkest = 1e-4f;  // Red, green and blue cannot mix all colours: some have a negative component.
    constexpr double thinnest = 1e-30, densest = 1e30;  // The distance stays within the range of floats between these.
    Absorption absorption;
    const double mean = mean_of([&](double nanometres) { return spectrum->mean_around(nanometres); });
    if (mean > 0.0) {
        const auto distance = 1.0 / std::clamp(mean, thinnest, densest);
        const auto left =
            colour_of([&](double nanometres) { return std::exp(-spectrum->mean_around(nanometres) * distance); });
        absorption = left_after(glm::clamp(glm::vec3(left), darkest, 1.0f), static_cast<float>(distance));
    }
    absorption.spectrum_ = std::move(spectrum);
    return absorption;
}

}  // namespace phasetree::tracer
