// A camera for domes, or a fisheye lens: the angle from the axis increases linearly with the distance from the centre
// of the picture.
//
// The field of view spans the circle at the centre of the picture whose diameter is the picture's shorter side. Beyond
// it, the angle continues to increase, up to directly behind the camera (the equidistant azimuthal projection, r ∝ θ).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct DomeParameters {
    glm::vec3 position{0.0f};
    glm::vec3 look_at{0.0f, 1.0f, 0.0f};  ///< at the centre of the picture
    glm::vec3 up{0.0f, 0.0f, 1.0f};       ///< see ViewFrame
    float fov_degrees = 180.0f;           ///< across the circle, in (0, 360]
};

class Dome {
  public:
    using Parameters = DomeParameters;

    /// Throws std::invalid_argument if the parameters are invalid.
    Dome(const DomeParameters& parameters, const glm::ivec2& resolution);

    /// See CameraKind; there is no lens.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    std::optional<glm::vec3> single_origin() const { return glm::vec3(frame_.position); }

  private:
    ViewFrame frame_;
    glm::dvec2 centre_;   ///< of the picture, in pixels
    double pixel_angle_;  ///< angle from the axis in radians, per pixel
};

}  // namespace phasetree::tracer
