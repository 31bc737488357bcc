// An orthographic camera: all rays are parallel to its axis, so that lengths across it are the same at any distance.
//
// A ray starts on the plane through the position that is perpendicular to the axis; what is behind that plane is not
// seen. As the thin lens does, it looks with +z up, and pixel (0, 0) is the top left one.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct OrthographicParameters {
    glm::vec3 position{0.0f, -5.0f, 0.0f};  ///< the middle of the plane on which rays start
    glm::vec3 look_at{0.0f};
    glm::vec3 up{0.0f, 0.0f, 1.0f};  ///< as ViewFrame has it
    float height = 2.0f;             ///< of what the whole picture shows, in the scene's unit of length
};

class Orthographic {
  public:
    using Parameters = OrthographicParameters;

    /// Throws std::invalid_argument when the parameters describe no camera.
    Orthographic(const OrthographicParameters& parameters, const glm::ivec2& resolution);

    /// As CameraKind has it; there is no lens.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    std::optional<glm::vec3> single_origin() const { return std::nullopt; }

  private:
    ViewFrame frame_;
    glm::dvec2 centre_;  ///< of the picture, in pixels
    double pixel_size_;  ///< in the scene's unit of length
};

}  // namespace phasetree::tracer
