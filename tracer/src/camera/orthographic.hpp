// An orthographic camera: all rays are parallel to its axis, so that lengths perpendicular to it are the same at any
// distance.
//
// Rays start on the plane through the position that is perpendicular to the axis; anything behind that plane is
// invisible. As for the thin lens, +z is up, and pixel (0, 0) is the top left one.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct OrthographicParameters {
    glm::vec3 position{0.0f, -5.0f, 0.0f};  ///< centre of the plane on which rays start
    glm::vec3 look_at{0.0f};
    glm::vec3 up{0.0f, 0.0f, 1.0f};  ///< see ViewFrame
    float height = 2.0f;             ///< of the visible area, in the scene's unit of length
};

class Orthographic {
  public:
    using Parameters = OrthographicParameters;

    /// Throws std::invalid_argument if the parameters are invalid.
    Orthographic(const OrthographicParameters& parameters, const glm::ivec2& resolution);

    /// See CameraKind; there is no lens.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    std::optional<glm::vec3> single_origin() const { return std::nullopt; }

  private:
    ViewFrame frame_;
    glm::dvec2 centre_;  ///< of the picture, in pixels
    double pixel_size_;  ///< in the scene's unit of length
};

}  // namespace phasetree::tracer
