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
    const bool is_other = std::ranges::find(known, found) != known.end();
    const std::string hint =
        is_other ? fmt::format("; of {} is the mesh \"{}\"", file.string(), found.substr(1)) : std::string();
    throw ParameterError("file", fmt::format("the name of the file must end with {}{}", ending, hint));
}

}  // namespace phasetree::tracer
