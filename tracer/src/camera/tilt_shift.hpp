// A camera with a lens that shifts and tilts, for architecture and for planes of focus that lie along a table.
//
// A pixel's ray goes from a point of the lens to where the ray through the lens's centre meets the plane of focus, as
// that of a thin lens. But the film may be moved across the axis, so that verticals stay parallel while one looks up,
// and the plane of focus may be tilted. With o on the lens, c through its centre, and n the plane's normal at the
// distance d along the axis f,
//
//     direction ∥ c − o (c·n) / (d f·n),
//
// which also holds for rays that diverge from the plane: they are in focus behind the camera, or nowhere.
//
// By Scheimpflug's rule the planes of the film, of the lens and of focus meet in a line, so that the lens itself is
// tilted by the atan of (film's distance / d) · tan(tilt), next to nothing but for near objects. By that little the
// opening would look narrower; we leave this out.
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
    glm::vec3 look_at{0.0f};         ///< on the axis: in the middle of the image if nothing is shifted
    glm::vec3 up{0.0f, 0.0f, 1.0f};  ///< as ViewFrame has it
    float vertical_fov_degrees = 40.0f;
    std::optional<float> focus_distance;  ///< along the axis; otherwise to look_at
    /// By which the image moves to the right and up, in heights of the image: at (0, 0.5) its lower edge is where its
    /// middle was.
    glm::vec2 shift{0.0f};
    /// Degrees by which the plane of focus leans away from the camera at its top (x) and turns away at its right (y).
    glm::vec2 tilt{0.0f};
};

class TiltShift {
  public:
    using Parameters = TiltShiftParameters;

    /// Throws std::invalid_argument when the parameters describe no camera.
    TiltShift(const TiltShiftParameters& parameters, const glm::ivec2& resolution);

    /// As CameraKind has it.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    /// The pinhole's.
    std::optional<glm::vec3> single_origin() const;

    /// Of unit length, away from the camera; the plane is at the focus distance along the axis.
    const glm::dvec3& focus_normal() const { return focus_normal_; }

  private:
    ViewFrame frame_;
    Aperture aperture_;
    double pixel_size_;  ///< on the plane at distance 1
    glm::dvec2 middle_;  ///< of the picture in pixels, where the axis meets it
    glm::dvec3 focus_normal_;
    double focus_reach_;  ///< d f·n
};

}  // namespace phasetree::tracer
