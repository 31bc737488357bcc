#pragma once

#include "embree_core/cell_scene.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::embree {

/// Lines through an object by its cells, for meshes of its phases. The cells have been built without
/// CellOptions::opaque, or there is nothing where opaque phases meet. The scene must outlive what is returned.
LineTracer line_tracer(const CellScene& scene);

}  // namespace phasetree::embree
