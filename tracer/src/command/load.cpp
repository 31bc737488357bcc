#include "command/load.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "command/errors.hpp"
#include "command/streams.hpp"
#include "film_file/write.hpp"
#include "output/error.hpp"
#include "output/write.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/meshes_alone.hpp"
#include "scene/one_tree.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

Program record_tree(const Document& document, const Phased& object) {
    return made_of_tree(document, [&] { return record(object); });
}

Document read_document_beside_input(const SceneFile& file) {
    if (file.is_standard_input())
        throw InputError(
            "<stdin>: the scene must be a file, because this command reads other data from standard input");
    return read_document(file);
}

Value model_in(const Document& document) {
    if (has_meshes_alone(document)) return document.root().find("meshes").value();
    return document.root().find(has_objects(document) ? "objects" : "tree").value();
}

SceneTree read_model(const Document& document, const std::optional<std::string>& object) {
    return tree_of_model(document, read_scene_model(document), object);
}

SceneTree tree_of_model(const Document& document, const SceneModel& model, const std::optional<std::string>& object) {
    if (!object && model.placed.empty()) return {model.phases, model.object};
    if (!object) return {model.phases, made_of_tree(document, [&] { return as_one_tree(model.placed); })};
    std::vector<std::string> names;
    for (const PlacedObject& one : model.placed.objects) {
        if (one.name == *object) return {model.phases, one.tree};
        names.push_back(one.name);
    }
    throw UsageError(names.empty() ? "--object: the scene has a single \"tree\" and no \"objects\""
                                   : fmt::format("--object: unknown object \"{}\" (choose from {})", *object,
                                                 fmt::join(names, ", ")));
}

void make_one_tree(const Document& document, Scene& scene) {
    if (scene.placed.empty()) return;
    scene.object = made_of_tree(document, [&] { return as_one_tree(scene.placed); });
    scene.placed = {};
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

bool need_display(const std::vector<std::string>& outputs) {
    return std::ranges::any_of(
        outputs, [](const std::string& output) { return !is_film_file(output) && needs_display(output); });
}

void print_warning(const std::string& file, const std::string& warning) {
    if (!warning.empty()) say("{}: warning: {}\n", file, warning);
}

namespace {

// The phase at a point of the scene. Where several objects contain it, the first one decides.
Phase phase_at(const Document& document, const Scene& scene, const glm::vec3& point) {
    // Evaluate the program, not the tree. A shared shape occurs once in the program but once per use in a walk of the
    // tree, which might never end.
    const auto of_tree = [&](const Phased& tree, const Bounds& box, const glm::vec3& p) {
        const Evaluator evaluator(record_tree(document, tree));
        return box.contains(p) ? evaluator.label(p, Evaluator::thread_workspace()) : phasetree::vacuum;
    };
    if (scene.placed.empty()) {
        (void)made_of_tree(document, [&] { return prepare_to_trace(scene.object); });
        return of_tree(scene.object, bounds(scene.object), point);
    }
    std::map<const PhasedNode*, Bounds> boxes;
    for (const PlacedObject& object : scene.placed.objects) boxes.emplace(object.tree.node(), bounds(object.tree));
    Phase found = phasetree::vacuum;
    scene.placed.each_copy([&](std::uint32_t, const PlacedObject& object, const Transform& to_scene) {
        const Bounds& box = boxes.at(object.tree.node());
        if (to_scene.image(box).contains(point))
            found = of_tree(object.tree, box, glm::vec3(to_scene.inverse()(point)));
        return found == phasetree::vacuum;
    });
    return found;
}

}  // namespace

Scene load_scene(const Document& document, NodePlaces* places) {
    Scene scene = read_scene(document, places);
    const Phase phase = phase_at(document, scene, position_of(scene.camera));
    if (!is_clear(scene.materials[phase.index]))
        throw document.error(*document.root().find("camera"),
                             fmt::format("the camera is inside the phase \"{}\", which is opaque; move the camera",
                                         scene.phases[phase]));
    if (scene.lights.empty() && !scene.is_emissive())
        throw document.error(document.root(),
                             "the scene has no lights, so every picture would be black; add one to \"lights\"");
    return scene;
}

}  // namespace phasetree::tracer
