#include <fmt/format.h>

#include <algorithm>

#include "phasetree/io/read_kind.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

void check_textures(const Mesh& mesh) {
    if (mesh.uv.empty() && has_texture<MeshImageTexture>(mesh.material))
        throw ParameterError("material",
                             "the texture \"mesh_image\" needs texture coordinates, which not all faces of this mesh "
                             "have; \"image\" needs none");
    if (mesh.colors.empty() && has_texture<VertexColorTexture>(mesh.material))
        throw ParameterError("material",
                             "the texture \"vertex_color\" needs colours, which not all vertices of this mesh have");
}

}  // namespace

std::vector<Mesh> read_meshes(const Document& document, Value list) {
    if (!list.is_array())
        throw document.error(list, fmt::format("\"meshes\" must be a list, but is {}", name_of(list.kind())));
    std::vector<Mesh> meshes;
    std::vector<std::string_view> kinds;
    for (const Value value : list) {
        with_kind(MeshKinds(), document, value, "a mesh", [&]<class Kind>(Value member) {
            meshes.push_back(
                read_kind<Kind>(document, member, fmt::format("the {}", Kind::info.name), [&](const Kind& kind) {
                    Mesh mesh = kind.made();
                    mesh.material = kind.material;
                    const auto same = 1 + std::ranges::count(kinds, Kind::info.name);
                    mesh.name = same == 1 ? std::string(Kind::info.name) : fmt::format("{} {}", Kind::info.name, same);
                    kinds.push_back(Kind::info.name);
                    check_textures(mesh);
                    return mesh;
                }));
        });
    }
    return meshes;
}

}  // namespace phasetree::tracer
