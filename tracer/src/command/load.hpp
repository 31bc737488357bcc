#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command/scene_file.hpp"
#include "output/display.hpp"
#include "phasetree/program/program.hpp"
#include "scene/scene.hpp"
#include "scene/unbounded_error.hpp"

namespace phasetree::tracer {

// Reads a scene and checks that it can be rendered. In addition to the checks of read_scene, the object must not be too
// large, too small or too far away, the camera must not be inside an opaque phase, and something must emit light.
// Throws SceneError. `places` receives the positions of the object's nodes in the text.
Scene load_scene(const Document&, NodePlaces* places = nullptr);

// How to display the scene. Options take precedence over the scene's settings. Throws DisplayError for errors in the
// options or in the configuration in $OCIO, and SceneError for the scene's view.
DisplayTransform display_of(const Document&, const RenderSettings&, const std::optional<std::string>& display,
                            const std::optional<std::string>& view, std::optional<float> exposure);

// Whether any of these outputs stores display values, and thus needs display_of. Film and EXR files store linear light,
// whatever $OCIO is.
bool need_display(const std::vector<std::string>& outputs);

// Reads a document for a subcommand that reads other data from standard input, so the scene cannot come from there.
// Throws InputError.
Document read_document_beside_input(const SceneFile&);

// Reads only the tree of a scene, which need not have anything else. For a scene of several objects, returns their
// union, or the object of this name.
SceneTree read_model(const Document&, const std::optional<std::string>& object = {});

// As read_model, for a model that has already been read.
SceneTree tree_of_model(const Document&, const SceneModel&, const std::optional<std::string>& object = {});

// Turns a scene of several objects into one with a single tree. Throws SceneError if there are too many objects.
void make_one_tree(const Document&, Scene&);
// Where errors of the scene's object are located: at "tree", at "objects", or at "meshes" if there are only meshes.
Value model_in(const Document&);

// Calls make(tree) with the document's tree, and returns the result. If the object does not allow it (it is unbounded
// or too large), the exception becomes an error at the node responsible, or at "tree".
template <class F>
auto made_of_tree(const Document& document, F&& make) {
    try {
        return make();
    } catch (const ModelError& e) {
        throw object_error(document, model_in(document), e);
    }
}

// Prints a warning to standard error if the scene's object is hard to trace (TraceableObject::warning).
void print_warning(const std::string& file, const std::string& warning);

// The object's program. Throws SceneError if it is too large: a few nested shapes can stand for billions.
Program record_tree(const Document& document, const Phased& object);

}  // namespace phasetree::tracer
