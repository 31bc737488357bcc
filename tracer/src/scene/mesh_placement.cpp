#include "scene/mesh_placement.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace phasetree::tracer {

void check_ending_of_mesh(const std::filesystem::path& file, std::string_view ending) {
    std::string found = file.extension().string();
    std::ranges::transform(found, found.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (found == ending) return;
    constexpr std::array<std::string_view, 4> known{".obj", ".ply", ".stl", ".glb"};
    std::string hint;
    if (found == ".gltf")
        hint = "; a .gltf file has its parts in files of their own, so save it as glTF Binary, .glb";
    else if (std::ranges::find(known, found) != known.end())
        hint = fmt::format("; for {} use the mesh \"{}\"", file.string(), found.substr(1));
    throw ParameterError("file", fmt::format("the name of the file must end with {}{}", ending, hint));
}

}  // namespace phasetree::tracer
