// The meshes of a glTF file where its nodes place them.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <vector>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

struct PlacedMesh {
    std::size_t mesh = 0;  ///< its number in "meshes"
    glm::dmat4 placement{1};
    bool is_skinned = false;  ///< then it is where its skin is at rest, and no node moves it
};

/// All of the file's scene, or of the first one if it names none, in the order of its nodes. Animations, the joints of
/// skins and the weights of morph targets are passed over. Throws GltfError.
std::vector<PlacedMesh> placed_meshes(const Document&);

}  // namespace phasetree::tracer::gltf
