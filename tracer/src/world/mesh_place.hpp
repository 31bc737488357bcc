// Where a ray meets a mesh: the point, and what the mesh's corners say of it.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "scene/mesh.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

/// A place of a triangle of a mesh by barycentric coordinates, of which u belongs to the second corner and v to the
/// third, as Embree has them.
struct MeshPlace {
    const Mesh& mesh;
    std::size_t triangle;
    float u, v;

    /// Exact to an ulp of the coordinates of the triangle, however far the ray has come.
    glm::vec3 point() const;
    /// The mean of values at the triangle's corners.
    template <class T>
    T mean(const AtCorners<T>& values) const {
        return at_barycentric(mesh, values, triangle, u, v);
    }
    /// Texture coordinates and colours, without tangents. Nothing if the mesh has neither.
    std::optional<MeshCoordinates> coordinates() const;
    /// Adds the tangents of a mesh that has some. `normal` is the shading normal on the side from which the mesh is
    /// seen; from behind, tangent and bitangent are turned round, as the normal is.
    void add_tangents(MeshCoordinates& coordinates, const glm::vec3& normal, bool is_behind) const;
};

}  // namespace phasetree::tracer
