#include "media/absorption.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

Absorption Absorption::of(SharedSpectrum spectrum) {
    constexpr float darkest = 1e-4f;  // of a colour that red, green and blue cannot mix
    constexpr double densest = 1e30;  // of what is told of in colours, so that its distance is no float too small
    Absorption absorption;
    const double mean = mean_of([&](double nanometres) { return spectrum->mean_around(nanometres); });
    if (mean > 0.0) {
        const auto distance = static_cast<float>(1.0 / std::min(mean, densest));
        const auto left = colour_of([&](double nanometres) {
            return static_cast<double>(std::exp(-spectrum->at(static_cast<float>(nanometres)) * distance));
        });
        absorption = left_after(glm::clamp(glm::vec3(left), darkest, 1.0f), distance);
    }
    absorption.spectrum_ = std::move(spectrum);
    return absorption;
}

}  // namespace phasetree::tracer
