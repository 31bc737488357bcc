// A camera that sees all around: the whole sphere of directions on a picture twice as wide as high.
//
// Columns are azimuths, rows angles from straight up, both in equal steps (the equirectangular or lat-long projection).
// The middle of the picture is the axis, which need not be level: the picture's poles are then turned with the camera.
// The left edge and the right one are behind the camera.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct PanoramaParameters {
    glm::vec3 position{0.0f};
    glm::vec3 look_at{0.0f, 1.0f, 0.0f};  ///< in the middle of the picture
    glm::vec3 up{0.0f, 0.0f, 1.0f};       ///< as ViewFrame has it
};

class Panorama {
  public:
    using Parameters = PanoramaParameters;

    /// Throws std::invalid_argument when the parameters describe no camera.
    Panorama(const PanoramaParameters& parameters, const glm::ivec2& resolution);

    /// As CameraKind has it; there is no lens.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    std::optional<glm::vec3> single_origin() const { return glm::vec3(frame_.position); }

  private:
    ViewFrame frame_;
    glm::dvec2 resolution_;
};

}  // namespace phasetree::tracer
