#include "command/load.hpp"

#include <fmt/format.h>

#include "phasetree/program/evaluator.hpp"

namespace phasetree::tracer {

Program record_tree(const Document& document, const Phased& object) {
    return made_of_tree(document, [&] { return record(object); });
}

Scene load_scene(const std::string& file) {
    const Document document = Document::from_file(file);
    Scene scene = read_scene(document);
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
    return scene;
}

}  // namespace phasetree::tracer
