// Reads meshes from glTF files, one per material.
#include <fmt/format.h>

#include <system_error>

#include "gltf/read_gltf.hpp"
#include "parameters/named_file.hpp"
#include "scene/gltf_files.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/mesh_placement.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::string_view most = "1 GiB";

}  // namespace

bool is_gltf(const std::filesystem::path& file) {
    return has_ending_of_mesh(file, {".gltf", ".glb"});
}

// Links that lead out of the folder are rejected, because they could also leave the folder that all files of a scene
// must be in.
std::filesystem::path file_of_gltf(const std::filesystem::path& gltf, const std::string& name) {
    const std::filesystem::path folder = gltf.has_parent_path() ? gltf.parent_path() : ".";
    std::error_code problem;
    const std::filesystem::path real = std::filesystem::canonical(folder / name, problem);
    if (problem) return folder / name;  // missing; its reader reports it
    const std::filesystem::path within = std::filesystem::canonical(folder, problem);
    const auto [end, rest] = std::mismatch(within.begin(), within.end(), real.begin(), real.end());
    if (problem || end != within.end())
        throw ParameterError("file", fmt::format("{} is outside the folder of {}", name, gltf.string()));
    return folder / name;
}

std::vector<std::filesystem::path> files_of_gltf(const std::filesystem::path& gltf) {
    std::vector<std::filesystem::path> files;
    try {
        const std::string content = read_whole_file(gltf, most_bytes_of_mesh, most);
        // The buffers' names are known without reading them.
        const gltf::Document document(content, [](const std::string&) { return std::string(); });
        for (const std::string& name : document.files()) {
            try {
                files.push_back(file_of_gltf(gltf, name));
            } catch (const ParameterError&) {  // a link that leads out of the folder is not followed
            }
        }
    } catch (const std::runtime_error&) {  // reading the mesh reports the same error
    }
    return files;
}

void GltfParameters::check() const {
    check_ending_of_mesh(file, {".gltf", ".glb"});
}

gltf::GltfFile read_gltf_file(const std::filesystem::path& file, const gltf::ReadOptions& options) {
    const auto read_named = [&](const std::string& name) {
        try {
            return read_whole_file(file_of_gltf(file, name), most_bytes_of_mesh, most);
        } catch (const ParameterError& e) {
            throw gltf::GltfError(fmt::format("cannot be read: {}", e.what()));
        }
    };
    try {
        return gltf::read_gltf(read_whole_file(file, most_bytes_of_mesh, most), options, read_named);
    } catch (const gltf::GltfError& e) {
        throw ParameterError("file", fmt::format("{}: {}", file.string(), e.what()));
    }
}

MeshGroup GltfParameters::made() const {
    check();
    gltf::GltfFile read = read_gltf_file(
        file, {.materials = material ? gltf::ReadMaterials::none : gltf::ReadMaterials::all,
               .clear = imported ? gltf::ReadClear::skip : gltf::ReadClear::warn,
               .panes = imported && !panes ? gltf::ReadPanes::as_clear : gltf::ReadPanes::as_thin_glass});
    MeshGroup group;
    for (gltf::Part& part : read.parts) {
        Mesh mesh{.vertices = std::move(part.mesh.vertices),
                  .triangles = std::move(part.mesh.triangles),
                  .normals = std::move(part.normals),
                  .uv = std::move(part.texture),
                  .colors = std::move(part.colors),
                  .second_uv = std::move(part.second_texture),
                  .alphas = std::move(part.alphas),
                  .tangents = std::move(part.tangents),
                  .opacity = std::move(part.opacity),
                  .material = material.value_or(part.material),
                  .name = std::move(part.name)};
        place(mesh, placement(), file);
        group.meshes.push_back(std::move(mesh));
    }
    for (const std::string& sentence : read.not_shown)
        group.not_shown.push_back(fmt::format("{}: {}", file.string(), sentence));
    return group;
}

}  // namespace phasetree::tracer
