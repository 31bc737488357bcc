// Files of meshes, by the reading of the node `mesh`: what is no solid is refused, and of what is one the search finds
// the piece that a loop over all of them would.
#include <bit>

#include "fuzz/input_file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/math/float_mode.hpp"
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

void look(const Mesh& mesh) {
    const float* data = mesh.table.data();
    const FlushSubnormals flush;
    for (const float share : {-0.1f, 0.25f, 0.5f}) {
        const glm::vec3 at = mesh.box.low + share * mesh.box.extent();
        const Vec3<float> p{at.x, at.y, at.z};
        const float found = Mesh::distance(data, p), looped = mesh::PieceList::distance(data, p);
        promised(std::bit_cast<std::uint32_t>(found) == std::bit_cast<std::uint32_t>(looped),
                 "the nearest piece is found");
        PointRange range;
        for (std::size_t i = 0; i < 3; ++i) {
            range.centre[i] = static_cast<double>(at[static_cast<int>(i)]);
            range.reach[i] = 0.01 * static_cast<double>(mesh.box.diagonal());
        }
        std::vector<float> few;
        if (!Mesh::specialise(data, range, {}, few)) continue;
        promised(Mesh::Specialised::is_sound(few), "few pieces are sound");
        const float local = Mesh::Specialised::distance(few.data(), p);
        promised(std::bit_cast<std::uint32_t>(found) == std::bit_cast<std::uint32_t>(local),
                 "the nearest piece is among the few of a box");
    }
}

}  // namespace

void run_mesh(Bytes input) {
    try {
        FromFile<TriangleMesh> file{"mesh", std::make_shared<const TriangleMesh>(read_mesh(written(input)))};
        Mesh mesh{.file = std::move(file)};
        mesh.prepare();
        look(mesh);
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
