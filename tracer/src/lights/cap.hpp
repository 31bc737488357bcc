// A cap of the sphere of directions: all those within an angle θ of an axis. Sampled uniformly, p = 1/(2π(1 − cos θ)).
//
// Directions are floats, so one that was sampled in the cap may lie outside of it by a rounding error. The cap
// therefore reaches that much farther where a direction is given: otherwise what was sampled there would be lost, and
// of a small cap all of it.
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

class Cap {
  public:
    /// An axis of unit length, and θ in radians, in (0, π].
    Cap(const glm::vec3& axis, double angle);

    const glm::vec3& axis() const { return axis_; }
    /// The same cap about another axis.
    Cap about(const glm::vec3& axis) const {
        Cap other = *this;
        other.axis_ = axis;
        return other;
    }

    bool contains(const glm::vec3& direction) const {
        // |ω − axis|² = 2(1 − cos θ), which keeps its digits for small angles.
        const glm::vec3 chord = direction - axis_;
        return glm::dot(chord, chord) <= squared_chord_;
    }
    /// u in [0, 1)².
    glm::vec3 sample(const glm::vec2& u) const;
    /// The density of sample(), per steradian, in the cap; 0 elsewhere.
    float pdf(const glm::vec3& direction) const { return contains(direction) ? 1.0f / solid_angle() : 0.0f; }
    /// In steradians.
    float solid_angle() const;

  private:
    glm::vec3 axis_;
    float squared_chord_;  // from the axis to as far as the cap reaches
    float height_;         // 1 − cos θ, of which nothing would be left if the cosine were stored
};

}  // namespace phasetree::tracer
