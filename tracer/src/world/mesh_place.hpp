// A point where a ray meets a mesh, and the attributes interpolated there.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "scene/mesh.hpp"
#include "scene/transform.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

/// A point of a triangle of a mesh by barycentric coordinates: u belongs to the second corner and v to the third, as in
/// Embree.
struct MeshPlace {
    const Mesh& mesh;
    std::size_t triangle;
    float u, v;
    /// From the vertices as stored to their positions at the time of the ray, if the mesh moves. It scales all
    /// directions by the same factor.
    std::optional<Transform> moved{};

    /// A corner of the triangle, from 0 to 2, at the time of the ray.
    glm::vec3 corner(int i) const {
        const glm::vec3& stored = mesh.vertices[mesh.triangles[triangle][i]];
        return moved ? glm::vec3((*moved)(glm::dvec3(stored))) : stored;
    }
    /// A direction at the time of the ray, of the same length.
    glm::vec3 turned(const glm::vec3& stored) const;
    /// Precise to a few ulps of the triangle's coordinates, however long the ray was.
    glm::vec3 point() const;
    /// Interpolates values at the triangle's corners. Normals and tangents are those of the mesh as stored.
    template <class T>
    T mean(const AtCorners<T>& values) const {
        return at_barycentric(mesh, values, triangle, u, v);
    }
    /// The point on the smooth surface that the triangle approximates, if that bulges out of the triangle towards the
    /// ray's side; otherwise the point itself. The point is projected onto the tangent planes of the corners, and the
    /// three results are averaged. The mesh must have normals.
    ///
    /// Rays that leave from there are not shadowed by the surrounding triangles, whose edges would be visible at
    /// grazing light. Reference: Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021, chapter 4.
    glm::vec3 point_of_smooth_surface(bool is_behind) const;
    /// Texture coordinates, colours and their alpha, without tangents. Returns nullopt if the mesh has none of them.
    std::optional<MeshCoordinates> coordinates() const;
    /// Adds the tangents of a mesh that has some. `normal` is the shading normal on the side from which the mesh is
    /// seen. From behind, tangent and bitangent are reversed, like the normal.
    void add_tangents(MeshCoordinates& coordinates, const glm::vec3& normal, bool is_behind) const;
};

}  // namespace phasetree::tracer
