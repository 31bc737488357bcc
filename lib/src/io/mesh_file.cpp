#include "io/mesh_file.hpp"

#include <algorithm>
#include <string>

#include "io/read_file.hpp"
#include "phasetree/io/error.hpp"

namespace phasetree {

TriangleMesh read_mesh(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (ending == ".obj") return io::read_obj(path, io::read_file(path));
    if (ending == ".ply") return io::read_ply(path, io::read_file(path));
    if (ending == ".stl") return io::read_stl(path, io::read_file(path));
    throw SceneError(path.string(), "is no mesh: its name must end with .obj, .ply or .stl");
}

}  // namespace phasetree
