// What `info` says of meshes: their sizes and bounds.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "scene/mesh.hpp"

namespace phasetree::tracer {

nlohmann::ordered_json meshes_as_json(std::span<const Mesh>);
void print_meshes(std::span<const Mesh>);

}  // namespace phasetree::tracer
