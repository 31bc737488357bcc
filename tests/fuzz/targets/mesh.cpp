// Files of meshes, by the reading of the node `mesh`: what is no solid is refused, and of what is one the search finds
// the piece that a loop over all of them would.
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

}  // namespace

void run_mesh(Bytes input) {
    try {
        FromFile<TriangleMesh> file{"mesh", std::make_shared<const TriangleMesh>(read_mesh(written(input)))};
        Mesh mesh{.file = std::move(file)};
        mesh.prepare();
        promise_search<mesh::PieceList>(mesh, [](const PointRange&, const Vec3<float>&, float) {});
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
