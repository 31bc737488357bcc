#include <fmt/format.h>

#include "phasetree/trace/tracer.hpp"
#include "scene/file_parts.hpp"
#include "scene/image_parameters.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

// The parts that the file has, whether they are needed or not: a tree alone is good for something, too.
FileParts parts_of(ObjectReader& root) {
    FileParts::parameters([&](auto, const auto& p) { root.allow({p.name}); });
    root.finish();
    FileParts parts;
    FileParts::parameters([&](auto part, const auto& p) { parts.*part = root.value(p.name); });
    return parts;
}

// A part that is needed.
Value needed(ObjectReader& root, std::optional<Value> FileParts::*wanted) {
    std::string_view name;
    FileParts::parameters([&](auto part, const auto& p) {
        if (part == wanted) name = p.name;
    });
    return root.required_value(name);
}

void check_version(const Document& document, Value version) {
    if (as<int>(document, version, "\"version\"") != 1)
        throw document.error(version, "this program reads scenes of version 1");
}

Material read_phase_material(const Document& document, Value phase) {
    Material material = read_material(document, phase);
    if (needs_uv(material))
        throw document.error(phase,
                             "the texture \"mesh_image\" is for meshes, because phases have no texture "
                             "coordinates; use \"image\"");
    return material;
}

}  // namespace

Scene read_scene(const Document& document) {
    ObjectReader root(document, document.root(), "the scene");
    const FileParts parts = parts_of(root);
    check_version(document, needed(root, &FileParts::version));

    Scene scene;
    scene.file = document.name();
    SceneTree tree = read_tree(document, {.height_grid = read_height_grid});
    scene.phases = std::move(tree.phases);
    scene.object = std::move(tree.object);
    scene.materials.push_back(vacuum());
    for (const Value phase : needed(root, &FileParts::phases))
        scene.materials.push_back(read_phase_material(document, phase));
    scene.lights = read_lights(document, document.root());
    if (parts.meshes) scene.meshes = read_meshes(document, *parts.meshes);
    scene.camera = read_camera(document, needed(root, &FileParts::camera), scene.film);
    if (parts.render) scene.settings = read_settings(document, *parts.render, scene.film);

    // An object that cannot be traced is found here, and not after the meshes are in memory.
    try {
        (void)prepare_to_trace(scene.object);
    } catch (const ModelError& e) {
        throw document.error(*parts.tree, e.what());
    }
    return scene;
}

SceneTree read_scene_without_camera(const Document& document) {
    ObjectReader root(document, document.root(), "the scene");
    const FileParts parts = parts_of(root);
    if (parts.version) check_version(document, *parts.version);
    SceneTree tree = read_tree(document, {.height_grid = read_height_grid});
    (void)opaque_phases(document);
    (void)read_lights(document, document.root());
    if (parts.meshes) (void)read_meshes(document, *parts.meshes);
    FilmSettings unused;
    if (parts.render) (void)read_settings(document, *parts.render, unused);
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
    for (const Value phase : needed(root, &FileParts::phases))
        materials.push_back(phase.is_object() ? read_phase_material(document, phase) : vacuum());
    return opaque_phases(materials);
}

}  // namespace phasetree::tracer
