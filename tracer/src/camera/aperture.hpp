// The opening of a lens: a disk, or the regular polygon formed by the blades of an iris. Bright points out of focus
// have its shape.
#pragma once

#include <glm/vec2.hpp>

namespace phasetree::tracer {

struct ApertureParameters {
    float lens_radius = 0.0f;       ///< of the disk, or of the circumscribed circle of the polygon; 0 is a pinhole
    int blades = 0;                 ///< corners of the polygon, at least 3; 0 is a disk
    float rotation_degrees = 0.0f;  ///< anticlockwise as seen from behind the camera; at 0 a corner is on the right
};

class Aperture {
  public:
    /// Maximum number of corners of a polygon.
    static constexpr int most_blades = 64;

    /// Throws std::invalid_argument if the radius or the number of blades is invalid.
    explicit Aperture(const ApertureParameters& parameters);

    bool is_pinhole() const { return radius_ == 0.0; }
    /// A point of the opening, relative to its centre in the right and up directions; uniform in area for `u` in [0,
    /// 1)².
    glm::dvec2 sample(const glm::vec2& u) const;

  private:
    double radius_;
    int blades_;
    double rotation_;  ///< radians
};

}  // namespace phasetree::tracer
