#include "studio/scene_files.hpp"

#include <algorithm>
#include <span>
#include <system_error>

namespace phasetree::tracer::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view images[] = {".png", ".jpg", ".jpeg", ".exr", ".hdr", ".tif", ".tiff",
                                       ".tga", ".bmp", ".gif",  ".tx",  ".dpx", ".pfm"};
constexpr std::string_view meshes[] = {".obj", ".ply", ".stl"};
constexpr std::string_view obj[] = {".obj"}, ply[] = {".ply"}, stl[] = {".stl"}, gltf[] = {".gltf", ".glb"},
                           balls[] = {".csv", ".ply"}, fonts[] = {".ttf", ".otf"}, json[] = {".json"},
                           volumes[] = {".vdb"}, profiles[] = {".ies"};
constexpr std::string_view grids[] = {".vdb", ".png", ".tif", ".tiff", ".exr"};

struct Reads {
    std::string_view type, kind;  // an empty type stands for any
    std::span<const std::string_view> extensions;
};
constexpr Reads reads[] = {
    {"field", "mesh", meshes},
    {"", "obj", obj},
    {"", "ply", ply},
    {"", "stl", stl},
    {"", "gltf", gltf},
    {"", "balls", balls},
    {"", "text", fonts},
    {"", "siren", json},
    {"field", "volume", volumes},
    {"", "ies", profiles},
    {"", "labels", grids},
    {"", "height_map", images},
    {"texture", "image", images},
    {"light", "image", images},
    {"", "mesh_image", images},
    {"normal_map", "", images},
    {"voxels", "", grids},
    {"", "particles", balls},
    {"placed_object", "", json},
};

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return text;
}

// Whether a canonical path is inside a canonical folder.
bool is_inside(const fs::path& path, const fs::path& folder) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end();
}

}  // namespace

SceneFiles files_for(const fs::path& scene, std::string_view type, std::string_view kind) {
    const auto known = std::ranges::find_if(reads, [&](const Reads& one) {
        return (one.type.empty() || one.type == type) && (one.kind.empty() || one.kind == kind);
    });
    std::error_code error;
    const fs::path folder = fs::canonical(scene.has_parent_path() ? scene.parent_path() : fs::path("."), error);
    SceneFiles result;
    if (error) return result;
    std::size_t visited = 0;
    constexpr auto options = fs::directory_options::skip_permission_denied;  // does not follow links to folders
    for (fs::recursive_directory_iterator at(folder, options, error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (++visited > SceneFiles::most_visited || result.names.size() == SceneFiles::most) {
            result.has_more = true;
            break;
        }
        std::error_code ignored;
        if (at->is_directory(ignored)) {
            if (name.starts_with('.') || at.depth() + 1 >= SceneFiles::most_levels) at.disable_recursion_pending();
            continue;
        }
        if (name.starts_with('.') || !at->is_regular_file(ignored)) continue;
        const std::string extension = lower(at->path().extension().string());
        if (known != std::end(reads) && std::ranges::find(known->extensions, extension) == known->extensions.end())
            continue;
        std::error_code broken;
        if (const fs::path target = fs::canonical(at->path(), broken); broken || !is_inside(target, folder)) continue;
        result.names.push_back(at->path().lexically_relative(folder).generic_string());
    }
    std::ranges::sort(result.names);
    return result;
}

}  // namespace phasetree::tracer::studio
