#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "phasetree/io/read_kind.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/mesh_tangents.hpp"
#include "scene/meshes_alone.hpp"
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

// Only the placement is read at other times than the document's.
template <class Kind>
std::optional<MeshMotion> motion_of(const Document& document, Value member, const Shutter& shutter,
                                    const Placement& of_vertices, const Bounds& vertices) {
    const Document without_assets = document.without_assets();
    const auto placement = [](const Kind& kind) { return kind.placement(); };
    std::vector<PlacementMoment> moments;
    for (const double moment : moments_of(document, member, shutter))
        moments.push_back({moment, read_kind<Kind>(at_moment(without_assets, shutter, moment), member,
                                                   fmt::format("the {}", Kind::info.name), placement)});
    try {
        return motion_through(moments, of_vertices, vertices);
    } catch (const ModelError& e) {
        throw document.error(member, e.what());
    }
}

}  // namespace

MeshGroup read_meshes(const Document& document, Value list, const Shutter& shutter) {
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
            std::optional<Placement> placement;
            MeshGroup group =
                read_kind<Kind>(document, member, fmt::format("the {}", Kind::info.name), [&](const Kind& kind) {
                    placement = kind.placement();
                    if (is_left_unread(document, kind)) return MeshGroup{};
                    MeshGroup made = group_of(kind.made(), name);
                    for (Mesh& mesh : made.meshes) {
                        check_textures(mesh);
                        if (needs_tangents(mesh.material) && mesh.tangents.empty() && !mesh.uv.empty())
                            mesh.tangents = tangents_of(mesh);
                    }
                    return made;
                });
            const auto motion = motion_of<Kind>(document, member, shutter, *placement, bounds_of(group.meshes));
            for (Mesh& mesh : group.meshes) mesh.motion = motion;
            std::ranges::move(group.meshes, std::back_inserter(all.meshes));
            std::ranges::move(group.not_shown, std::back_inserter(all.not_shown));
        });
    }
    return all;
}

}  // namespace phasetree::tracer
