#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.hpp"

namespace phasetree::tracer {

/// The properties of a scene of several objects, as printed by `info`: each object's copies, phases and nodes, and the
/// bounding box of all.
nlohmann::ordered_json objects_as_json(const SceneModel&);
void print_objects(const SceneModel&);

}  // namespace phasetree::tracer
