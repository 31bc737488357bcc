// OBJ and its file of materials (Wavefront, *Advanced Visualizer Manual*, 1990s): an object for each phase.
#pragma once

#include <string>
#include <string_view>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

struct ObjFiles {
    std::string obj, mtl;
};

/// The closed surface of each chosen phase, with normals. They share the list of vertices, so where two phases touch
/// they name the same ones.
ObjFiles obj_of(const MeshedObject&, std::string_view name_of_mtl);

}  // namespace phasetree::tracer
