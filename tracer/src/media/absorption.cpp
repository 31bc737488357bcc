#include "media/absorption.hpp"

#include <cmath>

#include "image/luminance.hpp"

namespace phasetree::tracer {

Absorption Absorption::of(SharedSpectrum spectrum) {
    constexpr float darkest = 1e-4f;  // of a colour that red, green and blue cannot mix
    Absorption absorption;
    if (const float mean = luminance(spectrum->colour()); mean > 0.0f) {
        const float distance = 1.0f / mean;
        const auto left = colour_of([&](double nanometres) {
            return static_cast<double>(std::exp(-spectrum->at(static_cast<float>(nanometres)) * distance));
        });
        absorption = left_after(glm::clamp(glm::vec3(left), darkest, 1.0f), distance);
    }
    absorption.spectrum_ = std::move(spectrum);
    return absorption;
}

}  // namespace phasetree::tracer
