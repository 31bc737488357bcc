#include "scene/mesh_placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/vec4.hpp>
#include <string>
#include <utility>

#include "parameters/world_limits.hpp"

namespace phasetree::tracer {

namespace {

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return ending;
}

}  // namespace

bool has_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings) {
    return std::ranges::find(endings, ending_of(file)) != endings.end();
}

void check_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings) {
    if (has_ending_of_mesh(file, endings)) return;
    const std::string found = ending_of(file);
    std::string wanted;
    for (const std::string_view ending : endings) wanted += fmt::format("{}{}", wanted.empty() ? "" : " or ", ending);
    std::string hint;
    for (const auto& [ending, kind] :
         {std::pair(".obj", "obj"), {".ply", "ply"}, {".stl", "stl"}, {".glb", "gltf"}, {".gltf", "gltf"}})
        if (found == ending) hint = fmt::format("; for {} use the mesh \"{}\"", file.string(), kind);
    throw ParameterError("file", fmt::format("the name of the file must end in {}{}", wanted, hint));
}

void place(Mesh& mesh, const Placement& placement, const std::filesystem::path& file) {
    for (glm::vec3& p : mesh.vertices) {
        p = placement(p);
        for (int k = 0; k < 3; ++k)
            if (!coordinate.contains(p[k]))
                throw ParameterError(
                    "file", fmt::format("{} has a coordinate that is not a number, or beyond 10¹⁵", file.string()));
    }
    for (glm::vec3& n : mesh.normals.values) n = placement.turned(n);
    for (glm::vec4& t : mesh.tangents.values) t = glm::vec4(placement.turned(glm::vec3(t)), t.w);
}

}  // namespace phasetree::tracer
