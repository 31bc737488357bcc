// The readers of a scene's parts. All throw SceneError.
#pragma once

#include <optional>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/scene.hpp"
#include "scene/shutter.hpp"

namespace phasetree::tracer {

Material read_material(const Document& document, Value value);
// The materials of all phases, the vacuum first. Phases that are given none have nothing.
std::vector<std::optional<Material>> read_materials(const Document& document);
// Without clusters: lamps may still be added.
Lights read_lights(const Document& document, Value root);
// Sets the pixel filter of the film, too.
AnyCameraParameters read_camera(const Document& document, Value value, FilmSettings& film);
// The camera while the shutter is open; none if it stands still.
std::vector<CameraMoment> read_camera_moments(const Document& document, Value value, const Shutter& shutter);
MeshGroup read_meshes(const Document& document, Value list);
// Sets the size of the film, too.
RenderSettings read_settings(const Document& document, Value value, FilmSettings& film);

// The first channel of an image, as stored: integers of any width from 0 to 1, without a transfer function. Throws
// std::runtime_error.
HeightGrid read_height_grid(const std::filesystem::path&);

// Of all files that nodes name.
FileReaders file_readers();

}  // namespace phasetree::tracer
