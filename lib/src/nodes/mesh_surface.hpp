#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "model/preparation.hpp"
#include "nodes/box_tree.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::mesh {

/// An edge of a surface: its ends, and its two triangles. The first triangle traverses it from the first end to the
/// second. A rim is any other edge of a sheet: an open one, for example. It has one of its triangles twice.
struct SharedEdge {
    std::array<std::uint32_t, 2> ends, triangles;

    bool is_rim() const { return triangles[0] == triangles[1]; }
};

/// The surface of a solid. Corners at the same point are merged, and triangles with two equal corners are removed. Each
/// edge has two triangles with the same side outwards, and all triangles around a vertex are neighbours in a single
/// ring. Vertices and triangles are in ascending order, so that the surface, and hence each distance, is the same to
/// the last bit, whatever their order in a file.
struct Surface {
    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> numbers;  ///< of the triangles in the file, from 1
    std::vector<SharedEdge> edges;
    std::vector<glm::dvec3> normals;  ///< of the triangles, normalised

    glm::dvec3 at(std::uint32_t vertex) const { return vertices[vertex]; }
    glm::dvec3 corner(std::uint32_t triangle, int i) const { return at(triangles[triangle][i]); }
};

/// Thrown for a mesh that is not a clean surface. It can be repaired (mesh_repair/repair.hpp).
class UncleanMesh : public ModelError {
    using ModelError::ModelError;
};

/// Throws UncleanMesh if the triangles do not form such a surface, and ModelError if there are none or their numbers
/// are bad; `name` is the mesh's name in messages.
Surface surface_of(const TriangleMesh&, const std::string& name);

/// The triangles as they are, which need not be closed, nor the surface of a solid. Equal triangles are one, whichever
/// way they face. The normal of a triangle without area is 0. Throws ModelError as surface_of does.
Surface sheet_of(const TriangleMesh&, const std::string& name);

/// Throws UncleanMesh if two triangles cross, or touch outside their shared vertices and edges. The tree is that of the
/// triangles' boxes.
void require_no_crossing(const Surface&, const BoxTree&, const std::string& name, model::Preparation&);

/// Throws UncleanMesh if the solid is on the outside of a triangle, because the whole surface, or one of several, is
/// inside out.
void require_outward(const Surface&, const BoxTree&, const std::string& name, model::Preparation&);

/// The boxes around the triangles.
std::vector<Bounds> boxes_of(const Surface&);

/// A point as readable text.
std::string written(const glm::dvec3&);

}  // namespace phasetree::mesh
