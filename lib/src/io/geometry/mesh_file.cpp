#include "io/geometry/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/read_file.hpp"
#include "phasetree/io/error.hpp"

namespace phasetree {

void io::check_triangles(const std::filesystem::path& path, const TriangleMesh& mesh, std::size_t most) {
    if (mesh.triangles.size() > most)
        throw SceneError(path.string(), fmt::format("there are more than {} million triangles", most / 1'000'000));
}

MeshFile read_mesh_file(const std::filesystem::path& path, std::string_view content, std::size_t max_triangles) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    MeshFile file;
    if (ending == ".obj")
        file = io::read_obj(path, content, max_triangles);
    else if (ending == ".ply")
        file = io::read_ply(path, content, max_triangles);
    else if (ending == ".stl")
        file = io::read_stl(path, content);
    else
        throw SceneError(path.string(), "is not a mesh: its name must end in .obj, .ply or .stl");
    io::check_triangles(path, file.mesh, max_triangles);
    return file;
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
    return read_mesh_file(path, io::read_file(path), TriangleMesh::max_triangles).mesh;
}

}  // namespace phasetree
