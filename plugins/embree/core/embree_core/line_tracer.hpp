#pragma once

#include "embree_core/cell_scene.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::embree {

/// Lines through an object by its cells, for meshes of its phases. The cells must have been built without
/// CellOptions::opaque, or crossings are missing where opaque phases meet. The scene must outlive what is returned.
LineTracer line_tracer(const CellScene& scene);

}  // namespace phasetree::embree
