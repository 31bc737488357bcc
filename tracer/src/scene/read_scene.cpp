#include <fmt/format.h>

#include "phasetree/trace/tracer.hpp"
#include "scene/parts.hpp"

namespace phasetree::tracer {

namespace {

ObjectReader read_root(const Document& document) {
    ObjectReader root(document, document.root(), "the scene");
    root.allow({"version", "phases", "shapes", "tree", "meshes", "lights", "background", "camera", "render"});
    root.finish();
    return root;
}

void check_version(const Document& document, Value version) {
    if (as<int>(document, version, "\"version\"") != 1)
        throw document.error(version, "this program reads scenes of version 1");
}

}  // namespace

Scene read_scene(const Document& document) {
    ObjectReader root = read_root(document);
    check_version(document, root.required_value("version"));

    Scene scene;
    scene.file = document.name();
    SceneTree tree = read_tree(document, {.height_grid = read_height_grid});
    scene.phases = std::move(tree.phases);
    scene.object = std::move(tree.object);
    scene.materials.push_back(vacuum());
    for (const Value phase : root.required_value("phases")) scene.materials.push_back(read_material(document, phase));
    scene.lights = read_lights(document, document.root());
    if (const auto meshes = root.value("meshes")) scene.meshes = read_meshes(document, *meshes);
    scene.camera = read_camera(document, root.required_value("camera"), scene.film);
    if (const auto settings = root.value("render")) scene.settings = read_settings(document, *settings, scene.film);

    // An object that cannot be traced is found here, and not after the meshes are in memory.
    try {
        (void)prepare_to_trace(scene.object);
    } catch (const ModelError& e) {
        throw document.error(*root.value("tree"), e.what());
    }
    return scene;
}

SceneTree read_scene_without_camera(const Document& document) {
    ObjectReader root = read_root(document);
    if (const auto version = root.value("version")) check_version(document, *version);
    SceneTree tree = read_tree(document, {.height_grid = read_height_grid});
    (void)opaque_phases(document);
    (void)read_lights(document, document.root());
    if (const auto meshes = root.value("meshes")) (void)read_meshes(document, *meshes);
    FilmSettings unused;
    if (const auto settings = root.value("render")) (void)read_settings(document, *settings, unused);
    return tree;
}

PhaseSet opaque_phases(const std::vector<Material>& materials) {
    PhaseSet opaque;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (!is_clear(materials[i])) opaque = opaque | PhaseSet::of(Phase{static_cast<std::uint8_t>(i)});
    return opaque;
}

PhaseSet opaque_phases(const Document& document) {
    std::vector<Material> materials{vacuum()};
    ObjectReader root(document, document.root(), "the scene");
    for (const Value phase : root.required_value("phases"))
        materials.push_back(phase.is_object() ? read_material(document, phase) : vacuum());
    return opaque_phases(materials);
}

}  // namespace phasetree::tracer
