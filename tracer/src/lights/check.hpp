// Checks of a light's description. The messages, "… must be …", are for authors of scenes.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>
#include <string>

namespace phasetree::tracer {

inline bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline void check_colour(const glm::vec3& colour, const std::string& what) {
    if (!is_finite(colour) || colour.x < 0.0f || colour.y < 0.0f || colour.z < 0.0f) {
        throw std::invalid_argument(what + " must be three finite numbers, none of them negative");
    }
}

inline void check_point(const glm::vec3& point, const std::string& what) {
    if (!is_finite(point)) throw std::invalid_argument(what + " must be three finite numbers");
}

inline void check_positive(float value, const std::string& what) {
    if (!std::isfinite(value) || !(value > 0.0f)) throw std::invalid_argument(what + " must be a positive number");
}

inline void check_range(float value, float low, float high, const std::string& what) {
    if (!(value >= low && value <= high)) {
        const auto number = [](float x) {
            std::string text = std::to_string(x);
            text.erase(text.find_last_not_of('0') + 1);
            if (text.back() == '.') text.pop_back();
            return text;
        };
        throw std::invalid_argument(what + " must be between " + number(low) + " and " + number(high));
    }
}

}  // namespace phasetree::tracer
