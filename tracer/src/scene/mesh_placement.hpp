// What readers of mesh files have in common: checks of the file, and placement.
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

/// Whether the file name has one of these extensions, ignoring case.
bool has_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings);

/// Throws ParameterError for "file" unless its name has one of these extensions, such as ".obj", ignoring case.
void check_ending_of_mesh(const std::filesystem::path& file, std::initializer_list<std::string_view> endings);

/// Transforms vertices, normals and tangents. Throws ParameterError for "file" if coordinates exceed the limits of a
/// scene.
void place(Mesh& mesh, const Placement& placement, const std::filesystem::path& file);

}  // namespace phasetree::tracer
