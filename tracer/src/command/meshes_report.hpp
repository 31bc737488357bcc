// Sizes and bounds of meshes, as printed by `info`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "scene/mesh.hpp"

namespace phasetree::tracer {

nlohmann::ordered_json meshes_as_json(std::span<const Mesh>);
void print_meshes(std::span<const Mesh>);

}  // namespace phasetree::tracer
