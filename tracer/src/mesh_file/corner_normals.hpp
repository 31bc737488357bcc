// Normals for shading triangles as the smooth surface that they approximate.
#pragma once

#include <array>
#include <vector>

#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::tracer {

struct CornerNormals {
    std::vector<glm::vec3> normals;  ///< unit length; each belongs to one vertex
    /// The index of the normal of each corner of each triangle.
    std::vector<std::array<std::uint32_t, 3>> of;
};

/// Computes corner normals. A corner's normal is the mean over those triangles around its vertex whose normals differ
/// from its own triangle's by less than 30°, weighted by their angles at the vertex (Thürmer & Wüthrich, *Computing
/// Vertex Normals from Polygonal Facets*, Journal of Graphics Tools 1998). Edges of the object thus stay sharp.
CornerNormals corner_normals(const ClosedMesh&);

}  // namespace phasetree::tracer
