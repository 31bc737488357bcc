// A camera for domes, or a fisheye lens: the angle from the axis grows evenly from the middle of the picture outwards.
//
// The circle in the middle of the picture, as wide as its shorter side, has the field of view across; beyond it the
// angle goes on growing, up to straight behind the camera (the equidistant azimuthal projection, r ∝ θ).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct DomeParameters {
    glm::vec3 position{0.0f};
    glm::vec3 look_at{0.0f, 1.0f, 0.0f};  ///< in the middle of the picture
    glm::vec3 up{0.0f, 0.0f, 1.0f};       ///< as ViewFrame has it
    float fov_degrees = 180.0f;           ///< across the circle, above 0, at most 360
};

class Dome {
  public:
    using Parameters = DomeParameters;

    /// Throws std::invalid_argument when the parameters describe no camera.
    Dome(const DomeParameters& parameters, const glm::ivec2& resolution);

    /// As CameraKind has it; there is no lens.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    std::optional<glm::vec3> single_origin() const { return glm::vec3(frame_.position); }

  private:
    ViewFrame frame_;
    glm::dvec2 centre_;   ///< of the picture, in pixels
    double pixel_angle_;  ///< radians from the axis, for each pixel outwards
};

}  // namespace phasetree::tracer
