// A cap of the sphere of directions: all those within an angle θ of an axis. Sampled uniformly, p = 1/(2π(1 − cos θ)).
//
// Directions are floats, so a direction that was sampled in the cap may lie outside of it by a rounding error. Tests of
// given directions therefore use a slightly larger cap. Otherwise samples would be lost, and those of a small cap
// entirely.
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

class Cap {
  public:
    /// The axis has unit length; θ is in radians, in (0, π].
    Cap(const glm::vec3& axis, double angle);

    const glm::vec3& axis() const { return axis_; }
    /// The same cap about another axis.
    Cap about(const glm::vec3& axis) const {
        Cap other = *this;
        other.axis_ = axis;
        return other;
    }

    bool contains(const glm::vec3& direction) const {
        // ω − axis|² = 2(1 − cos θ), which stays precise for small angles.
        const glm::vec3 chord = direction - axis_;
        return glm::dot(chord, chord) <= squared_chord_;
    }
    /// u in [0, 1)².
    glm::vec3 sample(const glm::vec2& u) const;
    /// The pdf of sample() per steradian; 0 outside the cap.
    float pdf(const glm::vec3& direction) const { return contains(direction) ? 1.0f / solid_angle() : 0.0f; }
    /// In steradians.
    float solid_angle() const;

  private:
    glm::vec3 axis_;
    float squared_chord_;  // from the axis to the rim, including the tolerance
    float height_;         // 1 − cos θ; computed from a stored cosine, it would cancel
};

}  // namespace phasetree::tracer
