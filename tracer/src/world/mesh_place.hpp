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

    /// Exact to a few ulps of the triangle's coordinates, however far the ray came.
    glm::vec3 point() const;
    /// The mean of values at the triangle's corners.
    template <class T>
    T mean(const AtCorners<T>& values) const {
        return at_barycentric(mesh, values, triangle, u, v);
    }
    /// Where the smooth surface is that the triangle stands for, if it bulges out of the triangle towards the ray's
    /// side there; else the point itself. The point is projected onto the corners' tangent planes,
    /// and the three results are averaged. The mesh has normals.
    ///
    /// Rays that leave from there are not in the shadow of the triangles around, whose edges would show where light
    /// grazes the surface. Reference: Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021, chapter 4.
    glm::vec3 point_of_smooth_surface(bool is_behind) const;
    /// Texture coordinates, colours and their alpha, without tangents. Nothing if the mesh has none of them.
    std::optional<MeshCoordinates> coordinates() const;
    /// Adds the tangents of a mesh that has some. `normal` is the shading normal on the side from which the mesh is
    /// seen; from behind, tangent and bitangent are turned round, as the normal is.
    void add_tangents(MeshCoordinates& coordinates, const glm::vec3& normal, bool is_behind) const;
};

}  // namespace phasetree::tracer
