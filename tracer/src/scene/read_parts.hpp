// The readers of a scene's parts. All throw SceneError.
#pragma once

#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

Material read_material(const Document& document, Value value);
Lights read_lights(const Document& document, Value root);
ThinLensParameters read_camera(const Document& document, Value value);
std::vector<Mesh> read_meshes(const Document& document, Value list);
// All of "render"; what says how large the image is goes to the camera.
RenderSettings read_settings(const Document& document, Value value, ThinLensParameters& camera);

// The first channel of an image, as stored: integers of any width from 0 to 1, without a transfer function. Throws
// std::runtime_error.
HeightGrid read_height_grid(const std::filesystem::path&);

}  // namespace phasetree::tracer
