// The meshes of a glTF file where its nodes place them.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "gltf/accessors.hpp"

namespace phasetree::tracer::gltf {

/// For each joint of a skin the matrix from the space of the mesh to that of the file. A vertex goes to where the mean
/// of these matrices takes it, weighted by its own weights: linear blend skinning.
using Joints = std::vector<glm::dmat4>;

struct PlacedMesh {
    std::size_t mesh = 0;  ///< its number in "meshes"
    glm::dmat4 placement{1};
    /// Of a mesh with a skin; only vertices without joints go by the placement then.
    std::shared_ptr<const Joints> joints{};
    /// Of the morph targets of its primitives; those that are missing are 0. Null if all are.
    std::shared_ptr<const std::vector<float>> weights{};
};

struct PlacedMeshes {
    std::vector<PlacedMesh> meshes;
    bool has_hidden = false;  ///< whether KHR_node_visibility hides a node that has a mesh
};

/// The visible meshes of the file's scene, or of its first if it names none, in the order of its nodes, each in the
/// pose that its nodes have without animations. Throws GltfError, also for more than `most` of them.
PlacedMeshes placed_meshes(Accessors&, std::size_t most);

}  // namespace phasetree::tracer::gltf
