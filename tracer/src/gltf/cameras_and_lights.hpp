// The camera and the lights of a glTF file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/placed_meshes.hpp"
#include "gltf/read_gltf.hpp"

namespace phasetree::tracer::gltf {

struct CamerasAndLights {
    std::optional<Camera> camera{};        ///< the first perspective camera
    std::vector<PunctualLight> lights{};   ///< those that emit
    std::vector<std::string> not_shown{};  ///< sentences about orthographic cameras and about other lights
};

/// Throws GltfError.
CamerasAndLights cameras_and_lights(const Document&, const PlacedMeshes&);

}  // namespace phasetree::tracer::gltf
