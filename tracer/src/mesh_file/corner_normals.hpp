// Normals for those who shade triangles as the smooth surface that they stand for.
#pragma once

#include <array>
#include <vector>

#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::tracer {

struct CornerNormals {
    std::vector<glm::vec3> normals;  ///< of unit length; each belongs to one vertex
    /// For each corner of each triangle its normal.
    std::vector<std::array<std::uint32_t, 3>> of;
};

/// A corner's normal is the mean of those of the triangles around its vertex that differ by less than 30° from its own
/// triangle's, by their angles there (Thürmer & Wüthrich, *Computing Vertex Normals from Polygonal Facets*, Journal of
/// Graphics Tools 1998). So edges of the object stay sharp.
CornerNormals corner_normals(const ClosedMesh&);

}  // namespace phasetree::tracer
