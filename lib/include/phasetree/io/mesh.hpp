#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree {

/// Values at the corners of a mesh's triangles, such as normals: each triangle has the indices of three of them.
template <class T>
struct AtCorners {
    std::vector<T> values;
    /// One entry for each triangle. It is empty if there is one value for each vertex, in the same order: then the
    /// triangles' own indices are those of the values.
    std::vector<glm::uvec3> triangles;

    /// Whether there are no such values.
    bool empty() const { return values.empty(); }
    /// The value at a corner, 0 to 2, of a triangle. `of_vertices` are the mesh's triangles.
    const T& at(const std::vector<glm::uvec3>& of_vertices, std::size_t triangle, int corner) const {
        return values[(triangles.empty() ? of_vertices : triangles)[triangle][corner]];
    }
};

/// What a file says of a mesh. Texture coordinates and colours are there only if all triangles have them.
struct MeshFile {
    TriangleMesh mesh;
    AtCorners<glm::vec3> normals;  ///< as the file has them: of any length, which is 0 where it has none
    AtCorners<glm::vec2> texture;  ///< (0, 0) is the lower left corner of an image, (1, 1) the upper right one
    AtCorners<glm::vec3> colors;   ///< red, green and blue from 0 to 1, encoded as sRGB
};

/// Reads an OBJ, PLY or STL file, chosen by its file name extension. Faces of more than three corners are divided into
/// triangles of these corners, and those of fewer are passed over. Vertices that are no numbers are rejected only where
/// a face has them. `content` is all of the file, `path` its name. Throws SceneError, which quotes nothing of the file,
/// for what is none of these, and for more than this many triangles.
///
/// OBJ: v, with colours behind the coordinates if there are some, vt, vn and f. PLY: of "vertex" x y z, nx ny nz, red
/// green blue, and s t, u v or texture_u texture_v; of "face" the list vertex_indices or vertex_index, and the list
/// texcoord of two numbers for each corner. Colours that are whole numbers are divided by the largest of their type.
MeshFile read_mesh_file(const std::filesystem::path& path, std::string_view content, std::size_t most_triangles);

/// Reads the triangles alone, at most TriangleMesh::most_triangles, from a file.
TriangleMesh read_mesh(const std::filesystem::path&);

}  // namespace phasetree
