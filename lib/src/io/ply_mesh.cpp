// The vertices and faces of a PLY file.
#include <array>

#include "io/mesh_file.hpp"
#include "io/ply.hpp"
#include "phasetree/io/error.hpp"

namespace phasetree::io {

TriangleMesh read_ply(const std::filesystem::path& path, std::string_view content) {
    TriangleMesh mesh;
    Ply ply(path, content);
    for (const Ply::Element& e : ply.elements()) {
        if (e.name == "vertex") {
            const std::array column{e.find("x"), e.find("y"), e.find("z")};
            if (!column[0] || !column[1] || !column[2])
                throw SceneError(path.string(), "its vertices have no x, y and z");
            ply.for_each_row(e, [&](const Ply::Row& row) {
                glm::vec3 p;
                for (int i = 0; i < 3; ++i) {
                    const std::vector<double>& value = row[*column[static_cast<std::size_t>(i)]];
                    if (value.size() != 1) ply.fail(e, "a coordinate is not one number");
                    p[i] = static_cast<float>(value[0]);
                }
                mesh.vertices.push_back(p);
            });
        } else if (e.name == "face") {
            const auto list = e.find("vertex_indices") ? e.find("vertex_indices") : e.find("vertex_index");
            if (!list) throw SceneError(path.string(), "its faces have no vertex_indices");
            ply.for_each_row(e, [&](const Ply::Row& row) {
                const std::vector<double>& corners = row[*list];
                if (corners.size() < 3) ply.fail(e, "a face needs three vertices");
                for (const double c : corners)
                    if (!(c >= 0 && c < static_cast<double>(mesh.vertices.size())))
                        ply.fail(e, "a face names a vertex that does not exist");
                const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
                // A face of more corners is a fan about its first one.
                for (std::size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({at(0), at(i - 1), at(i)});
                if (mesh.triangles.size() > TriangleMesh::most_triangles)
                    ply.fail(e, "there are more triangles than 2 million");
            });
        } else {
            ply.for_each_row(e, [](const Ply::Row&) {});
        }
    }
    ply.finish();
    return mesh;
}

}  // namespace phasetree::io
