#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command/scene_file.hpp"
#include "output/display.hpp"
#include "phasetree/program/program.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// Reads a scene and makes sure that it can be rendered. Beyond what read_scene checks, the object must be neither too
// large nor too small nor too far away, the camera must not be inside an opaque phase, and something must shine. Throws
// SceneError. `places` receives where the object's nodes stand in the text.
Scene load_scene(const Document&, NodePlaces* places = nullptr);

// How a scene is shown. Options take precedence over the scene's settings. Throws DisplayError for the options or the
// configuration in $OCIO, SceneError for the scene's view.
DisplayTransform display_of(const Document&, const RenderSettings&, const std::optional<std::string>& display,
                            const std::optional<std::string>& view, std::optional<float> exposure);

// Whether any of these outputs shows the picture as a display does, so that it needs display_of. Film files and EXR
// files hold linear light, and are written whatever $OCIO is.
bool need_display(const std::vector<std::string>& outputs);

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
