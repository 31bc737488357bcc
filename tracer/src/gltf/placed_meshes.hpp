// The meshes, cameras and lights of a glTF file, placed by its nodes.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "gltf/accessors.hpp"

namespace phasetree::tracer::gltf {

/// For each joint of a skin, the matrix from the space of the mesh to that of the file. A vertex is transformed by the
/// mean of these matrices, weighted by the vertex's weights: linear blend skinning.
using Joints = std::vector<glm::dmat4>;

struct PlacedMesh {
    std::size_t mesh = 0;  ///< its number in "meshes"
    std::size_t node = 0;  ///< the number of its node in "nodes"
    glm::dmat4 placement{1};
    /// The joints of a mesh with a skin. `placement` then applies only to vertices without joints.
    std::shared_ptr<const Joints> joints{};
    /// The weights of the morph targets of its primitives; missing ones are 0. Null if all are 0.
    std::shared_ptr<const std::vector<float>> weights{};
};

/// A camera or a light.
struct PlacedElement {
    std::size_t number = 0;  ///< in its list
    glm::dmat4 placement{1};
};

struct PlacedMeshes {
    std::vector<PlacedMesh> meshes;
    std::vector<PlacedElement> cameras;
    std::vector<PlacedElement> lights;  ///< KHR_lights_punctual, at most 1000 that are visible
    bool has_hidden = false;            ///< whether KHR_node_visibility hides a node that has a mesh
};

/// The visible meshes of the file's default scene, or of its first scene, in the order of its nodes and in the pose
/// without animations. Throws GltfError, also for more than `most` meshes.
PlacedMeshes placed_meshes(Accessors&, std::size_t most);

}  // namespace phasetree::tracer::gltf
