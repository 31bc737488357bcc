// A transform that changes while the shutter is open.
//
// Between two moments a map is interpolated by its polar decomposition M = R S, of a rotation and a symmetric matrix
// (Shoemake and Duff: Matrix Animation and Polar Decomposition, Graphics Interface 1992): where the origin goes, and S,
// change linearly, and R by spherical linear interpolation the shorter way (Shoemake: Animating Rotation with
// Quaternion Curves, SIGGRAPH 1985). So a turn is a turn, without shrinking on the way, and a stretch stays along its
// own axes.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "scene/transform.hpp"

namespace phasetree::tracer {

/// A transform, taken apart: p ↦ turn (stretch p) + by.
struct Pose {
    glm::dquat turn{1, 0, 0, 0};
    glm::dmat3 stretch{1};  ///< symmetric; negative definite if the transform mirrors
    glm::dvec3 by{0};

    static Pose of(const Transform& transform);
    Transform transform() const { return {glm::mat3_cast(turn) * stretch, by}; }
    bool mirrors() const { return glm::determinant(stretch) < 0; }
};

/// By a share in [0, 1] of the way from one to the other. Both mirror, or neither; what is between them then is as far
/// from being flat as they are.
Pose between(const Pose& from, const Pose& to, double share);

class MovingTransform {
  public:
    struct Moment {
        double time = 0;  ///< a share of the time in which the shutter is open
        Pose pose{};
    };

    /// At two moments at least, in the order of their times, which rise from 0 to 1.
    explicit MovingTransform(std::vector<Moment> moments) : moments_(std::move(moments)) {}

    Transform at(double time) const;
    /// A box around the images of a box at all times.
    Bounds swept(const Bounds& box) const;
    /// By how much it makes lengths longer at most, at any time.
    double stretch() const;

  private:
    std::vector<Moment> moments_;
};

}  // namespace phasetree::tracer
