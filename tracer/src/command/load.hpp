#pragma once

#include <optional>
#include <string>

#include "command/scene_file.hpp"
#include "output/display.hpp"
#include "phasetree/program/program.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// Reads a scene and makes sure that it can be rendered: beside what read_scene finds, that the object is neither too
// large nor too small nor too far away, that the camera is not inside an opaque phase, that something shines, and that
// there is the view that the scene names. Throws SceneError. `places` is told where the object's nodes stand.
Scene load_scene(const Document&, NodePlaces* places = nullptr);

// How a scene is shown: as the options say, which come before what the scene says. Throws DisplayError for the options,
// SceneError for the scene.
DisplayTransform display_of(const Document&, const RenderSettings&, const std::optional<std::string>& display,
                            const std::optional<std::string>& view, std::optional<float> exposure);

// The same for a subcommand that reads something else from standard input, so that the scene cannot come from there.
// Throws InputError.
Document read_document_beside_input(const SceneFile&);

// The tree alone of a scene that need not have anything else: of several objects one that is all of them, or the one of
// this name.
SceneTree read_model(const Document&, const std::optional<std::string>& object = {});

// The same of a model that was read.
SceneTree tree_of_model(const Document&, const SceneModel&, const std::optional<std::string>& object = {});

// Makes of a scene of several objects one of one tree. Throws SceneError if there are too many.
void make_one_tree(const Document&, Scene&);
// What errors of the scene's object point to: "tree", "objects", or "meshes" if there are only those.
Value model_in(const Document&);

// What `make` makes of the document's tree; where the object allows of none (unbounded, too large), that is an error at
// "tree".
template <class F>
auto made_of_tree(const Document& document, F&& make) {
    try {
        return make();
    } catch (const ModelError& e) {
        throw document.error(model_in(document), e.what());
    }
}

// Tells people on standard error what makes a scene's object hard to trace (TraceableObject::warning), if anything
// does.
void print_warning(const std::string& file, const std::string& warning);

// The object's program. Throws SceneError for one that is too large: a few shapes of shapes can stand for billions.
Program record_tree(const Document& document, const Phased& object);

}  // namespace phasetree::tracer
