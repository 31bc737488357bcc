// Scenes that have meshes and no object: they are vacuum everywhere but at the meshes. So that all that works on one
// tree works on them, their tree is one that is empty.
#pragma once

#include <span>

#include "phasetree/math/bounds.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// Whether the document has "meshes", and neither "phases" nor anything that would be an object. Throws SceneError if,
/// beside meshes, there is only one of "phases" and "tree".
bool has_meshes_alone(const Document&);
/// The same of a scene that was read.
bool has_meshes_alone(const Scene&);

/// The object of such a scene: nothing of it is left, and its bounds are small.
Phased object_beside_meshes_alone();

/// Throws SceneError for such a scene, where an object is needed.
void refuse_meshes_alone(const Document&);

/// The smallest box around all meshes.
Bounds bounds_of(std::span<const Mesh>);

}  // namespace phasetree::tracer
