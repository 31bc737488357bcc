// A thin-lens camera (Cook, Porter, Carpenter: Distributed Ray Tracing, SIGGRAPH 1984).
//
// A pixel's ray goes from a point of the lens opening (aperture.hpp) around the position to where the ray through the
// lens's centre meets the plane of focus, which is perpendicular to the axis. Radius 0 is a pinhole. Up is +z, pixel
// (0, 0) is the top left one, and pixels are square.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "camera/aperture.hpp"
#include "camera/contract.hpp"
#include "camera/view_frame.hpp"

namespace phasetree::tracer {

struct ThinLensParameters : ApertureParameters {
    glm::vec3 position{0.0f, -5.0f, 0.0f};
    glm::vec3 look_at{0.0f};
    glm::vec3 up{0.0f, 0.0f, 1.0f};  ///< see ViewFrame
    float vertical_fov_degrees = 40.0f;
    std::optional<float> focus_distance;  ///< along the axis; otherwise to look_at
};

/// The lens radius of a photographic lens: its focal length over twice the f-number, with the focal length that gives
/// the field of view on a sensor of the given height. In the unit of `sensor_height`; full-frame film is 0.024 m high.
float lens_radius_from_f_number(float f_number, float vertical_fov_degrees, float sensor_height = 0.024f);

class ThinLens {
  public:
    using Parameters = ThinLensParameters;

    /// Throws std::invalid_argument if the parameters are invalid.
    ThinLens(const ThinLensParameters& parameters, const glm::ivec2& resolution);

    /// See CameraKind.
    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const;
    /// nullopt unless it is a pinhole camera.
    std::optional<glm::vec3> single_origin() const;

    float focus_distance() const { return static_cast<float>(focus_distance_); }

  private:
    ViewFrame frame_;
    Aperture aperture_;
    double pixel_size_;                ///< on the plane at distance 1
    double half_width_, half_height_;  ///< of the image in pixels
    double focus_distance_;
};

}  // namespace phasetree::tracer
