// The camera and the lights of a glTF file.
#pragma once

#include <optional>
#include <vector>

#include "gltf/placed_meshes.hpp"
#include "gltf/read_gltf.hpp"

namespace phasetree::tracer::gltf {

/// The first perspective camera, if there is one. Throws GltfError.
std::optional<Camera> camera_of(const Document&, const PlacedMeshes&);

/// The lights that emit. Throws GltfError.
std::vector<PunctualLight> lights_of(const Document&, const PlacedMeshes&);

}  // namespace phasetree::tracer::gltf
