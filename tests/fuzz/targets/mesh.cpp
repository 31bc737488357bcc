// Files of meshes, by the reading of the node `mesh`: what is no solid is rejected, and of what is one the search finds
// the piece that a loop over all of them would. What files say of triangles' corners is of corners that there are.
#include "phasetree/io/mesh.hpp"
#include "fuzz/found_by_search.hpp"
#include "fuzz/input_file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/mesh.hpp"

namespace phasetree::fuzz {

namespace {

// Which kind of file it is; the first words of an OBJ file are free.
const std::filesystem::path& written(Bytes input) {
    static InputFile obj("mesh.obj"), ply("mesh.ply"), stl("mesh.stl");
    const std::string_view text = text_of(input);
    if (text.starts_with("ply")) return ply.write(input);
    const bool is_obj = text.starts_with("v ") || text.starts_with("#") || text.starts_with("o ");
    return is_obj ? obj.write(input) : stl.write(input);
}

template <class T>
void promise_corners(const MeshFile& file, const AtCorners<T>& values) {
    if (values.empty()) return;
    promised(values.triangles.empty() || values.triangles.size() == file.mesh.triangles.size(),
             "each triangle has values at its corners");
    for (const glm::uvec3& t : values.triangles.empty() ? file.mesh.triangles : values.triangles)
        for (int i = 0; i < 3; ++i) promised(t[i] < values.values.size(), "values at corners exist");
}

}  // namespace

void run_mesh(Bytes input) {
    try {
        const std::filesystem::path& path = written(input);
        const MeshFile read = read_mesh_file(path, text_of(input), TriangleMesh::max_triangles);
        promise_corners(read, read.normals);
        promise_corners(read, read.texture);
        promise_corners(read, read.colors);
        FromFile<TriangleMesh> file{"mesh", std::make_shared<const TriangleMesh>(read_mesh(path))};
        Mesh mesh{.file = std::move(file)};
        mesh.prepare();
        promise_search<mesh::PieceList>(mesh, [](const PointRange&, const Vec3<float>&, float) {});
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
