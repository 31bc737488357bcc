#pragma once

#include <string>

#include "nodes/mesh_repair/cells.hpp"
#include "nodes/mesh_surface.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::mesh {

/// The surface of the solid that a mesh bounds, whatever is wrong with the mesh (chain.hpp). Throws ModelError if it
/// encloses nothing; `name` is the mesh's name in messages. Vertices must be finite, and triangle indices valid.
Surface repaired(const TriangleMesh&, WindingRule, const std::string& name, model::Preparation&);

}  // namespace phasetree::mesh
