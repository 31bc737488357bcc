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
};

/// All of the file's scene, or of the first one if it names none, in the order of its nodes. Animations, skins and
/// morphs are passed over, so everything is in its pose of rest. Throws GltfError.
std::vector<PlacedMesh> placed_meshes(const Document&);

}  // namespace phasetree::tracer::gltf
