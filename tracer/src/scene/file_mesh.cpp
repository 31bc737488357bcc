// Reads meshes from files and places them in the scene.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "image/srgb.hpp"
#include "parameters/named_file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/nodes/fields/joined_vertices.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/mesh_placement.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t max_triangles = 100'000'000;

// Merges equal vertices. In STL files each triangle has its own.
void join_corners(Mesh& mesh) {
    JoinedVertices joined = join_vertices(mesh.vertices, mesh.triangles);
    mesh.vertices = std::move(joined.points);
    for (glm::uvec3& t : mesh.triangles) t = {joined.of[t.x], joined.of[t.y], joined.of[t.z]};
}

// Vertex normals: the area-weighted means of the normals of the adjacent triangles.
AtCorners<glm::vec3> smooth_normals(const Mesh& mesh) {
    AtCorners<glm::vec3> normals;
    normals.values.assign(mesh.vertices.size(), glm::vec3(0.0f));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 n =
            glm::cross(mesh.vertices[t.y] - mesh.vertices[t.x], mesh.vertices[t.z] - mesh.vertices[t.x]);
        for (int i = 0; i < 3; ++i) normals.values[t[i]] += n;
    }
    return normals;
}

void make_unit(glm::vec3& v) {
    // In doubles, because the squares of large floats overflow.
    const double length = glm::length(glm::dvec3(v));
    v = length > 0 ? glm::vec3(glm::dvec3(v) / length) : glm::vec3(0.0f);
}

}  // namespace

void MeshFileParameters::check_without_file(std::string_view ending) const {
    check_ending_of_mesh(file, {ending});
    (void)opacity();
}

Mesh MeshFileParameters::read(std::string_view ending) const {
    const auto fail = [&](std::string_view what) {
        return ParameterError("file", fmt::format("{} {}", file.string(), what));
    };
    check_without_file(ending);
    MeshFile read;
    try {
        read = read_mesh_file(file, read_whole_file(file, most_bytes_of_mesh, "1 GiB"), max_triangles);
    } catch (const SceneError& e) {
        throw ParameterError("file", e.what());
    }
    if (read.mesh.triangles.empty()) throw fail("has no faces");

    Mesh mesh{.opacity = opacity(), .material = material};
    mesh.vertices = std::move(read.mesh.vertices);
    mesh.triangles = std::move(read.mesh.triangles);
    if (smooth) mesh.normals = std::move(read.normals);
    place(mesh, placement(), file);
    if (ending == ".stl") join_corners(mesh);
    if (smooth && mesh.normals.empty()) mesh.normals = smooth_normals(mesh);
    for (glm::vec3& n : mesh.normals.values) make_unit(n);
    mesh.uv = std::move(read.texture);
    mesh.colors = std::move(read.colors);
    for (glm::vec3& c : mesh.colors.values)
        for (int k = 0; k < 3; ++k) c[k] = linear_from_srgb(std::clamp(c[k], 0.0f, 1.0f));
    return mesh;
}

}  // namespace phasetree::tracer
