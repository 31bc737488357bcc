// What a scene needs besides its objects: camera, lights and render settings, from the file or by default.
#pragma once

#include "gltf/read_gltf.hpp"
#include "gltf_import/json_layout.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer::gltf_import {

/// The file's camera, or one that shows the subject from the front. `subject` is in the space of the scene.
SceneJson camera_of(const gltf::GltfFile& file, const Bounds& subject);

/// The file's lights plus a grey environment with about half of the lights' irradiance, because glTF cannot describe
/// environments. If the file has no lights: a lamp and an environment. One candela becomes a radiant intensity of 1 and
/// one lux an irradiance of 1, as one nit of an emissive material becomes a radiance of 1. A point light becomes a
/// small sphere, because without photons, the light of a point does not pass through clear surfaces.
SceneJson lights_of(const gltf::GltfFile& file, const Bounds& subject);

/// The image has the camera's aspect ratio. If the file has lights, the exposure is set for them, and photons
/// ("caustics") are enabled if the scene has clear phases (`has_phases`). The scene is spectral if a phase has an Abbe
/// number (`is_dispersive`).
SceneJson render_settings_of(const gltf::GltfFile& file, const Bounds& subject, bool has_phases, bool is_dispersive);

}  // namespace phasetree::tracer::gltf_import
