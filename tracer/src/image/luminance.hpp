// Luminance of linear Rec.709 colour (ITU-R BT.709-6, item 3.2).
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

inline float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// The brightness of the three numbers of a path, which are either colours or the values of three wavelengths
/// (spectrum/wavelengths.hpp). Wavelengths have equal weights, because they are sampled in proportion to their
/// importance.
inline float brightness(const glm::vec3& numbers, bool is_spectral) {
    return is_spectral ? (numbers.x + numbers.y + numbers.z) / 3.0f : luminance(numbers);
}

}  // namespace phasetree::tracer
