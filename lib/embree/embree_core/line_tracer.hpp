#pragma once

#include "embree_core/cell_scene.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::embree {

/// Make a line tracer that traces an object's cells, for meshing its phases. The cells must have been built without
/// CellOptions::opaque; otherwise crossings between opaque phases are missing. The scene must outlive the result.
LineTracer line_tracer(const CellScene& scene);

}  // namespace phasetree::embree
