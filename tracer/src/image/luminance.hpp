// Luminance of linear Rec.709 colour (ITU-R BT.709-6, item 3.2).
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

inline float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace phasetree::tracer
