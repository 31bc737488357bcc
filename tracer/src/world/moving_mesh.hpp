// Triangles in Embree: those of a mesh that stands still, or of one that moves while the shutter is open.
#pragma once

#include "scene/mesh.hpp"
#include "world/placed_geometry.hpp"

namespace phasetree::tracer {

/// The triangles of a mesh as they are stored, committed. Refers to the mesh if it has holes.
GeometryHandle triangles_of(RTCDevice device, const Mesh& mesh);

/// A user geometry with one primitive, the whole mesh. It transforms rays to the mesh as it is stored, and traces them
/// there. RTCRay::time is the time as a fraction of the time in which the shutter is open. Embree's own motion blur
/// would need vertices at equally spaced times, and would cut short the arcs of rotations.
class MovingMesh {
  public:
    /// Refers to the mesh, which must outlive it and have a motion. Hits have `id` as their geometry.
    MovingMesh(RTCDevice device, const Mesh& mesh, unsigned id);
    // Embree refers to it.
    MovingMesh(const MovingMesh&) = delete;
    MovingMesh& operator=(const MovingMesh&) = delete;

    RTCGeometry handle() const { return geometry_.get(); }
    /// A box around the mesh at all times.
    const Bounds& bounds() const { return bounds_; }
    /// The mesh as it is stored.
    RTCScene scene() const { return scene_.get(); }
    /// The transform from the mesh as it is stored to the scene.
    Transform at(float time) const { return mesh_.motion->at(static_cast<double>(time)); }

  private:
    const Mesh& mesh_;
    Bounds bounds_;
    SceneHandle scene_;
    GeometryHandle geometry_;
};

}  // namespace phasetree::tracer
