#pragma once

#include "scene/scene.hpp"

namespace phasetree::tracer {

/// Chooses the levels of detail of a scene's object for its camera and the size of its picture: the errors that their
/// nodes promise look no larger than this many pixels, wherever in the picture. Throws OutputError for a camera
/// whose rays do not start in one place.
void choose_levels_of_detail(Scene& scene, float pixels);

}  // namespace phasetree::tracer
