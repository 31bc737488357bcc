#pragma once

#include "scene/scene.hpp"

namespace phasetree::tracer {

/// Warns on standard error about contents of the scene's mesh files that will not be rendered.
void warn_of_what_is_not_shown(const Scene&);

}  // namespace phasetree::tracer
