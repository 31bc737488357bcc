#include "lights/cap.hpp"

#include <cmath>

#include "sampling/warps.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

Cap::Cap(const glm::vec3& axis, double angle) : axis_(axis) {
    // The error of a unit direction whose coordinates were rounded several times by a change of frame.
    constexpr double rounding = 2e-7;
    const double half_chord = std::sin(0.5 * angle), chord = 2.0 * half_chord + rounding;
    squared_chord_ = static_cast<float>(chord * chord);
    height_ = static_cast<float>(2.0 * half_chord * half_chord);
}

glm::vec3 Cap::sample(const glm::vec2& u) const {
    return glm::normalize(Frame(axis_).to_world(square_to_uniform_cone(u, height_)));
}

float Cap::solid_angle() const {
    return 1.0f / uniform_cone_pdf(height_);
}

}  // namespace phasetree::tracer
