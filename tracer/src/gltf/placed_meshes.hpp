// The meshes of a glTF file where its nodes place them.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

/// For each joint of a skin the matrix from the space of the mesh to that of the file. A vertex goes to where the mean
/// of these matrices takes it, weighted by its own weights: linear blend skinning.
using Joints = std::vector<glm::dmat4>;

struct PlacedMesh {
    std::size_t mesh = 0;  ///< its number in "meshes"
    glm::dmat4 placement{1};
    /// Of a mesh with a skin; only vertices without joints go by the placement then.
    std::shared_ptr<const Joints> joints{};
    bool is_morphed = false;  ///< whether the node has weights of morph targets that are not 0
};

/// The meshes of the file's scene, or of its first if it names none, in the order of its nodes, each in the pose that
/// its nodes have without animations. Throws GltfError, also for more than `most` of them.
std::vector<PlacedMesh> placed_meshes(const Document&, std::size_t most);

}  // namespace phasetree::tracer::gltf
