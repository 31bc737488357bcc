#include "command/load.hpp"

#include <fmt/format.h>

#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "output/error.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/parts.hpp"

namespace phasetree::tracer {

Program record_tree(const Document& document, const Phased& object) {
    return made_of_tree(document, [&] { return record(object); });
}

Document read_document_beside_input(const SceneFile& file) {
    if (file.is_standard_input())
        throw InputError("<stdin>: the scene cannot come from standard input, which is read for something else");
    return read_document(file);
}

SceneTree read_model(const Document& document) {
    return read_tree(document, {.height_grid = read_height_grid});
}

DisplayTransform display_of(const Document& document, const RenderSettings& settings,
                            const std::optional<std::string>& display, const std::optional<std::string>& view,
                            std::optional<float> exposure) {
    try {
        return DisplayTransform(display, view ? view : settings.view, exposure.value_or(settings.exposure_ev));
    } catch (const DisplayError& e) {
        if (view || display || !settings.view) throw;
        throw document.error(*document.root().find("render")->find("view"), e.what());
    }
}

void print_warning(const std::string& file, const std::string& warning) {
    if (!warning.empty()) say("{}: warning: {}\n", file, warning);
}

Scene load_scene(const Document& document) {
    Scene scene = read_scene(document);
    (void)made_of_tree(document, [&] { return prepare_to_trace(scene.object); });
    // By the program, in which a shared shape counts once a place: a walk through the tree might never end.
    const Evaluator evaluator(record_tree(document, scene.object));
    const Phase phase = bounds(scene.object).contains(scene.camera.position)
                            ? evaluator.label(scene.camera.position, Evaluator::thread_workspace())
                            : phasetree::vacuum;
    if (!is_clear(scene.materials[phase.index]))
        throw document.error(*document.root().find("camera"),
                             fmt::format("the camera is inside \"{}\", which is opaque", scene.phases[phase]));
    if (scene.lights.empty())
        throw document.error(document.root(), "the scene has no lights, so every image of it would be black");
    if (scene.settings.view) (void)display_of(document, scene.settings, {}, {}, {});
    return scene;
}

}  // namespace phasetree::tracer
