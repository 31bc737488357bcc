#include "command/load.hpp"

#include <fmt/format.h>

namespace phasetree::tracer {

Scene load_scene(const std::string& file) {
    const Document document = Document::from_file(file);
    Scene scene = read_scene(document);
    const Phase phase = bounds(scene.object).contains(scene.camera.position)
                            ? label(distances(scene.object, scene.camera.position))
                            : phasetree::vacuum;
    if (!is_clear(scene.materials[phase.index]))
        throw document.error(*document.root().find("camera"),
                             fmt::format("the camera is inside \"{}\", which is opaque", scene.phases[phase]));
    if (scene.lights.empty())
        throw document.error(document.root(), "the scene has no lights, so every image of it would be black");
    return scene;
}

}  // namespace phasetree::tracer
