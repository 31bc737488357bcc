// The opening of a lens: a disk, or the regular polygon that the blades of an iris leave, whose shape is that of bright
// points out of focus.
#pragma once

#include <glm/vec2.hpp>

namespace phasetree::tracer {

struct ApertureParameters {
    float lens_radius = 0.0f;       ///< of the disk, or of the circle about the polygon; 0 is a pinhole
    int blades = 0;                 ///< corners of the polygon, 3 at least; 0 is a disk
    float rotation_degrees = 0.0f;  ///< anticlockwise as the camera looks; at 0 a corner is at the right
};

class Aperture {
  public:
    /// The most corners that a polygon may have.
    static constexpr int most_blades = 64;

    /// Throws std::invalid_argument for a radius or a number of blades that makes no opening.
    explicit Aperture(const ApertureParameters& parameters);

    bool is_pinhole() const { return radius_ == 0.0; }
    /// A point of the opening, to the right and up from its centre; uniform in area for `u` in [0, 1)².
    glm::dvec2 sample(const glm::vec2& u) const;

  private:
    double radius_;
    int blades_;
    double rotation_;  ///< in radians
};

}  // namespace phasetree::tracer
