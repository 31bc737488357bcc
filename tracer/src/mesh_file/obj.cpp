#include "mesh_file/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "mesh_file/corner_normals.hpp"

namespace phasetree::tracer {

namespace {

// OBJ names end at blanks. If two phases would get the same name, their numbers are appended.
std::string in_obj(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) <= 32 || c == '#') c = '_';
    return name;
}

std::string color_text(const glm::vec3& c) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", c.x, c.y, c.z);
}

std::vector<std::string> names_in_obj(const MeshedObject& object) {
    std::vector<std::string> names;
    for (const Phase phase : object.phases()) names.push_back(in_obj(object.look(phase).name));
    const std::vector<std::string> all = names;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (std::ranges::count(all, all[i]) > 1) names[i] += fmt::format("_{}", object.phases()[i].index);
    return names;
}

std::string material_text(const std::string& name, const Look& look) {
    std::string text = fmt::format("newmtl {}\n", name);
    switch (look.kind) {
        case Look::clear:
            text += fmt::format("Kd {}\nKs 1 1 1\nNs 1000\nNi {}\nd 0.3\nillum 7\n",
                                color_text(glm::exp(-0.3f * look.absorption)), look.ior);
            break;
        case Look::metal:
            text += fmt::format("Kd 0 0 0\nKs {}\nNs 500\nillum 3\n", color_text(look.color));
            break;
        case Look::coated:
            text += fmt::format("Kd {}\nKs 0.04 0.04 0.04\nNs 500\nillum 2\n", color_text(look.color));
            break;
        case Look::glowing:
            text += fmt::format("Kd 0 0 0\nKe {}\nillum 1\n", color_text(look.color));
            break;
        case Look::diffuse:
            text += fmt::format("Kd {}\nillum 1\n", color_text(look.color));
            break;
    }
    return text + "\n";
}

}  // namespace

ObjFiles obj_of(const MeshedObject& object, std::string_view name_of_mtl) {
    const PhaseMesh& mesh = object.mesh;
    ObjFiles files{"# made by phasetree\n", "# made by phasetree\n"};
    auto out = std::back_inserter(files.obj);
    fmt::format_to(out, "mtllib {}\n", name_of_mtl);
    std::vector<std::uint32_t> number(mesh.vertices.size(), 0);  // index in the file, from 1
    std::uint32_t vertices = 0, normals = 0;
    const std::vector<std::string> names = names_in_obj(object);
    for (std::size_t p = 0; p < names.size(); ++p) {
        const Phase phase = object.phases()[p];
        files.mtl += material_text(names[p], object.look(phase));
        const ClosedMesh closed = surface_of(mesh, PhaseSet::of(phase));
        const CornerNormals corners = corner_normals(closed);
        fmt::format_to(out, "o {}\n", names[p]);
        for (const std::uint32_t v : closed.in_mesh) {
            if (number[v] > 0) continue;
            const glm::vec3& p = mesh.vertices[v];
            fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
            number[v] = ++vertices;
        }
        for (const glm::vec3& n : corners.normals) fmt::format_to(out, "vn {:.4f} {:.4f} {:.4f}\n", n.x, n.y, n.z);
        fmt::format_to(out, "usemtl {}\n", names[p]);
        for (std::size_t i = 0; i < closed.triangles.size(); ++i) {
            files.obj += 'f';
            for (std::size_t c = 0; c < 3; ++c)
                fmt::format_to(out, " {}//{}", number[closed.in_mesh[closed.triangles[i][c]]],
                               normals + corners.of[i][c] + 1);
            files.obj += '\n';
        }
        normals += static_cast<std::uint32_t>(corners.normals.size());
    }
    return files;
}

}  // namespace phasetree::tracer
