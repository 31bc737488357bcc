#pragma once

#include <string>

#include "scene/scene.hpp"

namespace phasetree::tracer {

// Reads a scene and makes sure that it can be traced: beside what read_scene finds, that the camera is not inside an
// opaque phase, and that something shines or the user is told. Throws SceneError.
Scene load_scene(const std::string& file);

}  // namespace phasetree::tracer
