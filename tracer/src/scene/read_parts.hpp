// Readers of the parts of a scene. All throw SceneError.
#pragma once

#include <optional>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/file_readers.hpp"
#include "phasetree/nodes/fields/height_grid.hpp"
#include "scene/scene.hpp"
#include "scene/shutter.hpp"

namespace phasetree::tracer {

Material read_material(const Document& document, Value value);
// The material in an entry of "phases".
Material read_material_of_phase(const Document& document, Value phase);
// The materials of all phases, the vacuum first; nullopt for phases without one.
std::vector<std::optional<Material>> read_materials(const Document& document);
// Does not cluster lamps, because more may be added.
Lights read_lights(const Document& document, Value root);
// Also sets the pixel filter of the film.
AnyCameraParameters read_camera(const Document& document, Value value, FilmSettings& film);
// The camera while the shutter is open; empty if it does not move.
std::vector<CameraMoment> read_camera_moments(const Document& document, Value value, const Shutter& shutter);
// Without a shutter, no mesh moves.
MeshGroup read_meshes(const Document& document, Value list, const Shutter& shutter = {});
// Also sets the size of the film.
RenderSettings read_settings(const Document& document, Value value, FilmSettings& film);

// The first channel of an image, as stored: integers of any width are scaled to [0, 1], without a transfer function.
// Throws std::runtime_error.
HeightGrid read_height_grid(const std::filesystem::path&);

// Readers of all files that nodes name.
FileReaders file_readers();

}  // namespace phasetree::tracer
