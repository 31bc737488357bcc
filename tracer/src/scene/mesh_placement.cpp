#include "scene/mesh_placement.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace phasetree::tracer {

void check_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings) {
    std::string found = file.extension().string();
    std::ranges::transform(found, found.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (std::ranges::find(endings, found) != endings.end()) return;
    std::string wanted;
    for (const std::string_view ending : endings) wanted += fmt::format("{}{}", wanted.empty() ? "" : " or ", ending);
    std::string hint;
    for (const auto& [ending, kind] :
         {std::pair(".obj", "obj"), {".ply", "ply"}, {".stl", "stl"}, {".glb", "gltf"}, {".gltf", "gltf"}})
        if (found == ending) hint = fmt::format("; for {} use the mesh \"{}\"", file.string(), kind);
    throw ParameterError("file", fmt::format("the name of the file must end with {}{}", wanted, hint));
}

}  // namespace phasetree::tracer
