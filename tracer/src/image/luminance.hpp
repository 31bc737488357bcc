// Luminance of linear Rec.709 colour (ITU-R BT.709-6, item 3.2).
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

inline float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// How bright the three numbers of a path are, which are colours or those of three wavelengths
/// (spectrum/wavelengths.hpp). Wavelengths count alike, because they are chosen by how much they count.
inline float brightness(const glm::vec3& numbers, bool is_spectral) {
    return is_spectral ? (numbers.x + numbers.y + numbers.z) / 3.0f : luminance(numbers);
}

}  // namespace phasetree::tracer
