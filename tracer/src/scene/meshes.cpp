#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "phasetree/io/read_kind.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/mesh_tangents.hpp"
#include "scene/parameter_relations.hpp"
#include "scene/read_parts.hpp"
#include "scene/unread_file.hpp"

namespace phasetree::tracer {

std::optional<Opacity> OpacityParameters::opacity() const {
    check_relations(relations_of_opacity(), [&](std::string_view name) {
        return name == "opacity" ? opacity_number.has_value() : opacity_cutoff.has_value();
    });
    if (!opacity_number) return std::nullopt;
    return Opacity{*opacity_number, opacity_cutoff};
}

namespace {

void check_textures(const Mesh& mesh) {
    if (mesh.uv.empty() &&
        (has_texture<MeshImageTexture>(mesh.material) || has_texture<MeshImageNumber>(mesh.material)))
        throw ParameterError("material", fmt::format("\"mesh_image\" needs texture coordinates, which some faces of "
                                                     "\"{}\" lack; use \"image\", which needs none",
                                                     mesh.name));
    if (mesh.uv.empty() && mesh.opacity && has_kind<MeshImageNumber>(mesh.opacity->number))
        throw ParameterError(
            "opacity",
            fmt::format("\"mesh_image\" needs texture coordinates, which some faces of \"{}\" lack", mesh.name));
    if (mesh.uv.empty() && normal_map_of(mesh.material))
        throw ParameterError("material", fmt::format("a \"normal_map\" needs texture coordinates, which some faces of "
                                                     "\"{}\" lack; use a \"bump\" with another kind of texture",
                                                     mesh.name));
    if (mesh.colors.empty() && has_texture<VertexColorTexture>(mesh.material))
        throw ParameterError(
            "material",
            fmt::format("the texture \"vertex_color\" needs colours, which some vertices of \"{}\" lack", mesh.name));
}

MeshGroup group_of(MeshGroup group, const std::string& name) {
    for (Mesh& mesh : group.meshes) mesh.name = fmt::format("{} {}", name, mesh.name);
    return group;
}
MeshGroup group_of(Mesh mesh, const std::string& name) {
    mesh.name = name;
    return {{std::move(mesh)}, {}};
}

}  // namespace

MeshGroup read_meshes(const Document& document, Value list) {
    if (!list.is_array())
        throw document.error(list, fmt::format("\"meshes\" must be a list, but is {}", name_of(list.kind())));
    MeshGroup all;
    std::vector<std::string_view> kinds;
    for (const Value value : list) {
        with_kind(MeshKinds(), document, value, "a mesh", [&]<class Kind>(Value member) {
            const auto same = 1 + std::ranges::count(kinds, Kind::info.name);
            kinds.push_back(Kind::info.name);
            const std::string name =
                same == 1 ? std::string(Kind::info.name) : fmt::format("{} {}", Kind::info.name, same);
            MeshGroup group =
                read_kind<Kind>(document, member, fmt::format("the {}", Kind::info.name), [&](const Kind& kind) {
                    if (is_left_unread(document, kind)) return MeshGroup{};
                    MeshGroup made = group_of(kind.made(), name);
                    for (Mesh& mesh : made.meshes) {
                        check_textures(mesh);
                        if (needs_tangents(mesh.material) && mesh.tangents.empty() && !mesh.uv.empty())
                            mesh.tangents = tangents_of(mesh);
                    }
                    return made;
                });
            std::ranges::move(group.meshes, std::back_inserter(all.meshes));
            std::ranges::move(group.not_shown, std::back_inserter(all.not_shown));
        });
    }
    return all;
}

}  // namespace phasetree::tracer
