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

/// Size by the camera's aspect ratio; exposure for the file's lights. `has_phases` says whether there are clear phases,
/// and `is_dispersive` whether one has an Abbe number.
SceneJson render_settings_of(const gltf::GltfFile& file, const Bounds& subject, bool has_phases, bool is_dispersive);

}  // namespace phasetree::tracer::gltf_import
