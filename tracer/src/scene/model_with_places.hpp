#pragma once

#include "phasetree/io/node_places.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// As read_scene_model; `places` receives the positions of the object's nodes in the text.
SceneModel read_scene_model(const Document&, NodePlaces& places);

}  // namespace phasetree::tracer
