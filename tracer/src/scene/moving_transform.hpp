// A transform that changes while the shutter is open.
//
// Between two moments, a map is interpolated by its polar decomposition M = R S into a rotation and a symmetric matrix
// (Shoemake and Duff: Matrix Animation and Polar Decomposition, Graphics Interface 1992). The translation and S are
// interpolated linearly, and R by spherical linear interpolation the shorter way (Shoemake: Animating Rotation with
// Quaternion Curves, SIGGRAPH 1985). A rotation thus stays a rotation, without shrinking on the way, and a stretch
// stays along its own axes.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "scene/transform.hpp"

namespace phasetree::tracer {

/// A decomposed transform: p ↦ turn (stretch p) + by.
struct Pose {
    glm::dquat turn{1, 0, 0, 0};
    glm::dmat3 stretch{1};  ///< symmetric; negative definite if the transform mirrors
    glm::dvec3 by{0};

    static Pose of(const Transform& transform);
    Transform transform() const { return {glm::mat3_cast(turn) * stretch, by}; }
    bool mirrors() const { return glm::determinant(stretch) < 0; }
};

/// Interpolates by `share`, in [0, 1]. Either both or neither must mirror. Then no map in between is closer to singular
/// than they are.
Pose between(const Pose& from, const Pose& to, double share);

class MovingTransform {
  public:
    struct Moment {
        double time = 0;  ///< as a fraction of the time in which the shutter is open
        Pose pose{};
    };

    /// Requires at least two moments, with increasing times from 0 to 1.
    explicit MovingTransform(std::vector<Moment> moments) : moments_(std::move(moments)) {}

    Transform at(double time) const;
    /// A box around the images of a box at all times.
    Bounds swept(const Bounds& box) const;
    /// An upper bound on the factor by which lengths grow at any time.
    double stretch() const;

  private:
    std::vector<Moment> moments_;
};

}  // namespace phasetree::tracer
