// A panoramic camera: the whole sphere of directions in a picture twice as wide as high.
//
// Columns are azimuths, and rows are angles from straight up, both in equal steps (the equirectangular or lat-long
// projection). The centre of the picture is the axis, which need not be level: the poles of the picture are rotated
// with the camera. The left and right edges are behind the camera.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct PanoramaParameters {
    glm::vec3 position{0.0f};
    glm::vec3 look_at{0.0f, 1.0f, 0.0f};  ///< at the centre of the picture
    glm::vec3 up{0.0f, 0.0f, 1.0f};       ///< see ViewFrame
};

class Panorama {
  public:
    using Parameters = PanoramaParameters;

    /// Throws std::invalid_argument if the parameters are invalid.
    Panorama(const PanoramaParameters& parameters, const glm::ivec2& resolution);

    /// See CameraKind; there is no lens.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    std::optional<glm::vec3> single_origin() const { return glm::vec3(frame_.position); }

  private:
    ViewFrame frame_;
    glm::dvec2 resolution_;
};

}  // namespace phasetree::tracer
