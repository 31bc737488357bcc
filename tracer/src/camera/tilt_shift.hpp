// A camera with a lens that shifts and tilts, for architecture and for planes of focus along a table.
//
// As for a thin lens, a pixel's ray goes from a point of the lens to where the ray through the lens's centre meets the
// plane of focus. But the film may be shifted perpendicular to the axis, so that verticals stay parallel when the
// picture is centred above or below the axis, and the plane of focus may be tilted. With o on the lens, c through its
// centre, and n the plane's normal at the distance d along the axis f,
//
//     direction ∥ c − o (c·n) / (d f·n),
//
// which also holds for rays that diverge from the plane: they are in focus behind the camera, or nowhere.
//
// By Scheimpflug's rule, the planes of the film, of the lens and of focus meet in a line. So the lens itself is tilted
// by the atan of (film's distance / d) · tan(tilt), which is negligible except for near objects. The slight
// foreshortening of the opening is ignored.
//
// Reference: Merklinger, Focusing the View Camera, 1996, chapters 3 and 4.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/aperture.hpp"
#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct TiltShiftParameters : ApertureParameters {
    glm::vec3 position{0.0f, -5.0f, 0.0f};
    glm::vec3 look_at{0.0f};         ///< on the axis: at the centre of the image without a shift
    glm::vec3 up{0.0f, 0.0f, 1.0f};  ///< see ViewFrame
    float vertical_fov_degrees = 40.0f;
    std::optional<float> focus_distance;  ///< along the axis; otherwise to look_at
    /// Displacement of the image to the right and up, in heights of the image: at (0, 0.5), its lower edge is where its
    /// centre was.
    glm::vec2 shift{0.0f};
    /// Degrees by which the plane of focus leans away from the camera at its top (x) and turns away at its right (y).
    glm::vec2 tilt{0.0f};
};

class TiltShift {
  public:
    using Parameters = TiltShiftParameters;

    /// Throws std::invalid_argument if the parameters are invalid.
    TiltShift(const TiltShiftParameters& parameters, const glm::ivec2& resolution);

    /// See CameraKind.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    /// nullopt unless it is a pinhole camera.
    std::optional<glm::vec3> single_origin() const;

    /// Unit length, away from the camera; the plane is at the focus distance along the axis.
    const glm::dvec3& focus_normal() const { return focus_normal_; }

  private:
    ViewFrame frame_;
    Aperture aperture_;
    double pixel_size_;  ///< on the plane at distance 1
    glm::dvec2 middle_;  ///< point of the picture on the axis, in pixels
    glm::dvec3 focus_normal_;
    double focus_reach_;  ///< d f·n
};

}  // namespace phasetree::tracer
