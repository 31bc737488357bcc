#pragma once

#include <string>

#include "phasetree/program/program.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// Reads a scene and makes sure that it can be traced: beside what read_scene finds, that the camera is not inside an
// opaque phase, and that something shines, and that the object
// is not too large. Throws SceneError.
Scene load_scene(const std::string& file);

// What `make` makes of the document's tree; where the object allows of none (unbounded, too large), that is an error at
// "tree".
template <class F>
auto made_of_tree(const Document& document, F&& make) {
    try {
        return make();
    } catch (const ModelError& e) {
        throw document.error(*document.root().find("tree"), e.what());
    }
}

// The object's program. Throws SceneError for one that is too large: a few shapes of shapes can stand for billions.
Program record_tree(const Document& document, const Phased& object);

}  // namespace phasetree::tracer
