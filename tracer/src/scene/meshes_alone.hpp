// Scenes with meshes but no object, which are vacuum except for the meshes. They are given an empty tree, so that code
// that works on a tree also works on them.
#pragma once

#include <span>

#include "phasetree/math/bounds.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// Whether the document has "meshes", and neither "phases" nor anything that defines an object. Throws SceneError if it
/// has meshes and only one of "phases" and "tree".
bool has_meshes_alone(const Document&);
/// As above, for a scene that has been read.
bool has_meshes_alone(const Scene&);

/// The object of such a scene: empty, with small bounds.
Phased object_beside_meshes_alone();

/// Throws SceneError for such a scene; for use where an object is required.
void refuse_meshes_alone(const Document&);

/// The bounding box of all meshes.
Bounds bounds_of(std::span<const Mesh>);

}  // namespace phasetree::tracer
