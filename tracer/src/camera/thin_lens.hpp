// A thin-lens camera (Cook, Porter, Carpenter: Distributed Ray Tracing, SIGGRAPH 1984).
//
// A pixel's ray goes from a point on the lens, a disk around the position, to where the ray through the lens's centre
// meets the plane of focus; that plane is perpendicular to the axis. Radius 0 is a pinhole. Up is +z, pixel (0, 0) is
// the top left one, pixels are square.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "camera/pixel_filter.hpp"

namespace phasetree::tracer {

struct CameraRay {
    glm::vec3 origin;
    glm::vec3 direction;  // unit length
};

struct ThinLensParameters {
    glm::vec3 position{0.0f, -5.0f, 0.0f};
    glm::vec3 look_at{0.0f};
    glm::vec3 up{0.0f, 0.0f, 1.0f};  // replaced by +y (or +x) when the camera looks along it
    float vertical_fov_degrees = 40.0f;
    float lens_radius = 0.0f;             // scene units
    std::optional<float> focus_distance;  // along the axis; otherwise to look_at
    int width = 1;                        // of the whole image in pixels, whatever part of it is rendered
    int height = 1;
    PixelFilter filter;
};

// The lens radius of a photographic lens: its focal length over twice the f-number, with the focal length that gives
// the field of view on a sensor of the given height. In the unit of `sensor_height`; full-frame film is 0.024 m high.
float lens_radius_from_f_number(float f_number, float vertical_fov_degrees, float sensor_height = 0.024f);

class ThinLens {
  public:
    // Throws std::invalid_argument when the parameters describe no camera.
    explicit ThinLens(const ThinLensParameters& parameters);

    // The ray of a sample of pixel (x, y); both samples are in [0, 1)².
    CameraRay generate(int x, int y, const glm::vec2& filter_sample, const glm::vec2& lens_sample) const;

    float focus_distance() const { return static_cast<float>(focus_distance_); }

  private:
    glm::dvec3 position_;
    glm::dvec3 right_, up_, forward_;  // orthonormal
    double pixel_size_;                // on the plane at distance 1
    double half_width_, half_height_;  // of the image in pixels
    double lens_radius_;
    double focus_distance_;
    PixelFilter filter_;
};

}  // namespace phasetree::tracer
