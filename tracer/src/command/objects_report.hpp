#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.hpp"

namespace phasetree::tracer {

/// What `info` says of a scene of several objects: each with its copies, phases and nodes, and the box around all.
nlohmann::ordered_json objects_as_json(const SceneModel&);
void print_objects(const SceneModel&);

}  // namespace phasetree::tracer
