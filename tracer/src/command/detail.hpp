#pragma once

#include "scene/scene.hpp"

namespace phasetree::tracer {

/// Chooses the levels of detail of a scene's object for its camera and resolution: the error that each node promises
/// covers at most this many pixels, anywhere in the picture. Throws UsageError for a camera whose rays do not start at
/// one point.
void choose_levels_of_detail(Scene& scene, float pixels);

}  // namespace phasetree::tracer
