#pragma once

#include "scene/scene.hpp"

namespace phasetree::tracer {

/// Says on standard error what is in the files of a scene's meshes and will not be seen.
void warn_of_what_is_not_shown(const Scene&);

}  // namespace phasetree::tracer
