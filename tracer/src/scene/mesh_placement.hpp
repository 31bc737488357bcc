// What reading meshes from files of all kinds has in common: what the files must be, and how they are placed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string_view>

#include "phasetree/io/kind.hpp"
#include "scene/mesh.hpp"
#include "scene/placement.hpp"

namespace phasetree::tracer {

inline constexpr std::uintmax_t most_bytes_of_mesh = std::uintmax_t{1} << 30;

/// Whether the name of the file has one of these endings, in any case.
bool has_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings);

/// Throws ParameterError of "file" unless the name of the file has one of these endings, such as ".obj", in any case.
void check_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings);

/// Moves vertices, normals and tangents. Throws ParameterError of "file" for coordinates that a scene cannot have.
void place(Mesh& mesh, const Placement& placement, const std::filesystem::path& file);

}  // namespace phasetree::tracer
