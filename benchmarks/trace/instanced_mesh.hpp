// One mesh in many places, by Embree's own instances.
#pragma once

#include <glm/mat4x3.hpp>
#include <span>

#include "mesh/triangles.hpp"
#include "trace/mesh_scene.hpp"
#include "world/placed_geometry.hpp"

namespace phasetree::bench {

class InstancedMesh {
  public:
    // A place says where the axes and the origin go. It only turns and moves.
    InstancedMesh(const Triangles& mesh, std::span<const glm::mat4x3> places);

    std::optional<MeshScene::Hit> intersect(const Ray& ray) const;
    // Buffers and Embree's hierarchies over triangles and places.
    std::size_t bytes() const { return mesh_.bytes(); }

  private:
    MeshScene mesh_;              // whose device the places have, too
    tracer::SceneHandle places_;  // before the device goes
};

}  // namespace phasetree::bench
