#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree {

/// Values at the corners of a mesh's triangles, such as normals. Each triangle has three indices into `values`.
template <class T>
struct AtCorners {
    std::vector<T> values;
    /// One entry per triangle. Empty if there is one value per vertex, in the order of the vertices; the mesh's
    /// triangles then index the values, too.
    std::vector<glm::uvec3> triangles;

    /// Whether there are no values.
    bool empty() const { return values.empty(); }
    /// The value at a corner, 0 to 2, of a triangle. `of_vertices` are the mesh's triangles.
    const T& at(const std::vector<glm::uvec3>& of_vertices, std::size_t triangle, int corner) const {
        return values[(triangles.empty() ? of_vertices : triangles)[triangle][corner]];
    }
};

/// The content of a mesh file. Texture coordinates and colours are present only if all triangles have them.
struct MeshFile {
    TriangleMesh mesh;
    AtCorners<glm::vec3> normals;  ///< as in the file: of any length; 0 where the file has none
    AtCorners<glm::vec2> texture;  ///< (0, 0) is the lower left corner of an image, (1, 1) the upper right one
    AtCorners<glm::vec3> colors;   ///< red, green and blue from 0 to 1, sRGB-encoded
};

/// Read an OBJ, PLY or STL file, chosen by the file name extension.
///
/// path            the file's name, for the format and for messages.
/// content         the whole file.
/// max_triangles  maximum number of triangles.
///
/// Faces with more than three corners are split into triangles; faces with fewer are skipped. Vertices with invalid
/// numbers are rejected only if a face uses them. Throws SceneError for other formats, malformed files, and files with
/// too many triangles; the message never contains text from the file.
///
/// * OBJ: the statements v (optionally with a colour after the coordinates), vt, vn and f.
/// * PLY. Element "vertex": x y z; nx ny nz; red green blue; texture coordinates as s t, u v or texture_u texture_v.
///   Element "face": the list vertex_indices or vertex_index; the list texcoord, with two numbers per corner. Integer
///   colours are divided by the maximum of their type.
MeshFile read_mesh_file(const std::filesystem::path& path, std::string_view content, std::size_t max_triangles);

/// Read only the triangles, at most TriangleMesh::max_triangles, from a file. Throws SceneError.
TriangleMesh read_mesh(const std::filesystem::path&);

}  // namespace phasetree
