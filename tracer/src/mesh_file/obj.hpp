// OBJ and its material file (Wavefront, *Advanced Visualizer Manual*, 1990s), with one object per phase.
#pragma once

#include <string>
#include <string_view>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

struct ObjFiles {
    std::string obj, mtl;
};

/// The closed surface of each chosen phase, with normals. The surfaces share one list of vertices, so touching phases
/// refer to the same ones.
ObjFiles obj_of(const MeshedObject&, std::string_view name_of_mtl);

}  // namespace phasetree::tracer
