// The motion of a mesh while the shutter is open: its placement changes, and its vertices, normals and tangents follow.
#pragma once

#include <optional>
#include <vector>

#include "scene/moving_transform.hpp"
#include "scene/placement.hpp"

namespace phasetree::tracer {

class MeshMotion {
  public:
    /// `placement` is the placement over time, and `of_vertices` the one with which the vertices are stored.
    MeshMotion(MovingTransform placement, const Transform& of_vertices)
        : placement_(std::move(placement)), to_file_(of_vertices.inverse()) {}

    /// The transform from the vertices as stored to their positions at a fraction of the time in which the shutter is
    /// open: a rotation, a scaling by one factor, and a translation.
    Transform at(double time) const { return placement_.at(time) * to_file_; }
    /// A box around the vertices at all times, given a box around them as stored.
    Bounds swept(const Bounds& box) const { return placement_.swept(to_file_.image(box)); }

  private:
    MovingTransform placement_;
    Transform to_file_;
};

/// A placement at a fraction of the time in which the shutter is open.
struct PlacementMoment {
    double time = 0;
    Placement placement;
};

/// The motion through placements at increasing times from 0 to 1, between which it is interpolated. Returns nullopt if
/// all are equal or there are none. Throws ModelError if the mesh would become too small, too large, or too far away.
std::optional<MeshMotion> motion_through(const std::vector<PlacementMoment>& moments, const Placement& of_vertices,
                                         const Bounds& vertices);

}  // namespace phasetree::tracer
