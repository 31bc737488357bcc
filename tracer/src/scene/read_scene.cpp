#include <fmt/format.h>

#include <algorithm>

#include "phasetree/trace/tracer.hpp"
#include "scene/file_parts.hpp"
#include "scene/glowing.hpp"
#include "scene/image_parameters.hpp"
#include "scene/meshes_alone.hpp"
#include "scene/nothing_left.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

// A setting of the image or of the camera is easily written one level too high.
void refuse_misplaced_settings(ObjectReader& root) {
    for (const Value member : root.document().root()) {
        const std::string_view key = member.key();
        const auto refuse = [&](const char* part) {
            throw root.document().error(member.key_offset(),
                                        fmt::format("\"{}\" stands in \"{}\", not in the scene itself", key, part));
        };
        ImageParameters::parameters([&](auto, const Parameter& p) {
            if (p.name == key) refuse("render");
        });
        for (const char* const name : {"position", "look_at", "fov"})
            if (key == name) refuse("camera");
    }
}

// The parts that the file has, whether they are needed or not: a tree alone is good for something, too.
FileParts parts_of(ObjectReader& root) {
    FileParts::parameters([&](auto, const auto& p) { root.allow({p.name}); });
    refuse_misplaced_settings(root);
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

// Where the schema is does not matter here, but it must be a name, as the schema itself says.
void check_schema(const Document& document, const FileParts& parts) {
    if (parts.schema) (void)as<std::string>(document, *parts.schema, "\"$schema\"");
}

void check_version(const Document& document, Value version) {
    if (as<int>(document, version, "\"version\"") != 1)
        throw document.error(version, "this program reads scenes of version 1");
}

Material read_phase_material(const Document& document, Value phase) {
    Material material = read_material(document, phase);
    if (has_texture<MeshImageTexture>(material) || has_texture<MeshImageNumber>(material))
        throw document.error(phase,
                             "the texture \"mesh_image\" is for meshes, because phases have no texture "
                             "coordinates; use \"image\"");
    if (has_texture<VertexColorTexture>(material))
        throw document.error(phase, "the texture \"vertex_color\" is for meshes, because phases have no vertices");
    if (normal_map_of(material))
        throw document.error(
            phase, "a \"normal_map\" is for meshes, because phases have no texture coordinates; use a \"bump\"");
    return material;
}

}  // namespace

namespace {

// Adds a phase's material, unless the voxels of all would be more than a machine may hold.
void add_material(const Document& document, Value phase, Scene& scene) {
    constexpr std::size_t most_bytes_of_voxels = std::size_t{4} << 30;
    scene.materials.push_back(read_phase_material(document, phase));
    std::size_t bytes = 0;
    for (const Material& material : scene.materials)
        if (const Clear* clear = std::get_if<Clear>(&material))
            if (const auto* varying = std::get_if<VaryingMedium>(&clear->interior)) bytes += varying->bytes();
    if (bytes > most_bytes_of_voxels)
        throw document.error(phase, "the voxels of this phase and of those before it would take more than 4 GiB");
}

void refuse_places_of_nothing(const Document& document) {
    for (const char* const part : {"instances", "groups"})
        if (const auto value = document.root().find(part))
            throw document.error(value->key_offset(), fmt::format("\"{}\" is of no use without \"objects\"", part));
}

void read_model_into(const Document& document, const FileParts& parts, const Shutter& shutter, NodePlaces* places,
                     Scene& scene) {
    scene.materials.push_back(vacuum());
    if (parts.objects) {
        ObjectsModel model = read_placed_objects(document, shutter, places);
        scene.phases = std::move(model.phases);
        scene.placed = std::move(model.placed);
        for (const auto& source : model.materials) add_material(source.document, source.material, scene);
        return;
    }
    refuse_places_of_nothing(document);
    if (has_meshes_alone(document)) {
        scene.object = object_beside_meshes_alone();
        scene.materials.push_back(vacuum());
        return;
    }
    SceneTree tree = read_tree(document, file_readers(), places);
    scene.phases = std::move(tree.phases);
    scene.object = with_bounds(tree.object);
    for (const Value phase : *parts.phases) add_material(document, phase, scene);
}

}  // namespace

bool Scene::shines() const {
    PhaseSet present = object ? phasetree::phases(object) : PhaseSet{};
    for (const PlacedObject& one : placed.objects) present = present | phasetree::phases(one.tree);
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (present.contains(static_cast<int>(i)) && tracer::shines(materials[i])) return true;
    return std::ranges::any_of(meshes, [](const Mesh& mesh) { return tracer::shines(mesh.material); });
}

std::vector<std::string> object_names(const Scene& scene) {
    std::vector<std::string> names;
    if (scene.placed.empty()) names.emplace_back("object");
    for (const PlacedObject& object : scene.placed.objects) names.push_back(object.name);
    for (const Mesh& mesh : scene.meshes) names.push_back(mesh.name);
    return names;
}

SceneModel read_scene_model(const Document& document) {
    if (has_objects(document)) {
        ObjectsModel model = read_placed_objects(document);
        return {std::move(model.phases), {}, std::move(model.placed)};
    }
    refuse_places_of_nothing(document);
    refuse_meshes_alone(document);
    SceneTree tree = read_tree(document, file_readers());
    return {std::move(tree.phases), std::move(tree.object), {}};
}

Scene read_scene(const Document& document, NodePlaces* places) {
    ObjectReader root(document, document.root(), "the scene");
    const FileParts parts = parts_of(root);
    check_schema(document, parts);
    check_version(document, needed(root, &FileParts::version));

    Scene scene;
    scene.file = document.name();
    if (parts.render) scene.settings = read_settings(document, *parts.render, scene.film);
    const Shutter shutter{scene.settings.shutter.x, scene.settings.shutter.y};
    read_model_into(document, parts, shutter, places, scene);
    scene.lights = read_lights(document, document.root());
    if (parts.meshes) {
        MeshGroup group = read_meshes(document, *parts.meshes);
        scene.meshes = std::move(group.meshes);
        scene.not_shown = std::move(group.not_shown);
    }
    const Value camera = needed(root, &FileParts::camera);
    scene.camera = read_camera(at_moment(document, shutter, 0), camera, scene.film);
    scene.camera_moments = read_camera_moments(document, camera, shutter);

    // An object that cannot be traced is found here, and not after the meshes are in memory.
    try {
        if (scene.object) (void)prepare_to_trace(scene.object);
        find_glowing_parts(scene);
    } catch (const ModelError& e) {
        throw document.error(parts.tree ? *parts.tree : document.root(), e.what());
    }
    scene.lights.cluster_lamps();
    return scene;
}

SceneModel read_scene_without_camera(const Document& document) {
    ObjectReader root(document, document.root(), "the scene");
    const FileParts parts = parts_of(root);
    check_schema(document, parts);
    if (parts.version) check_version(document, *parts.version);
    SceneModel model;
    if (has_meshes_alone(document)) {
        refuse_places_of_nothing(document);
        model.object = object_beside_meshes_alone();
    } else {
        model = read_scene_model(document);
        (void)opaque_phases(document);
    }
    (void)read_lights(document, document.root());
    if (parts.meshes) (void)read_meshes(document, *parts.meshes);
    FilmSettings unused;
    if (parts.render) (void)read_settings(document, *parts.render, unused);
    return model;
}

PhaseSet opaque_phases(const std::vector<Material>& materials) {
    PhaseSet opaque;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (!is_clear(materials[i])) opaque = opaque | PhaseSet::of(Phase{static_cast<std::uint8_t>(i)});
    return opaque;
}

PhaseSet opaque_phases(const Document& document) {
    std::vector<Material> materials{vacuum()};
    const auto add = [&](const Document& source, Value phase) {
        materials.push_back(phase.is_object() ? read_phase_material(source, phase) : vacuum());
    };
    if (has_objects(document)) {
        for (const auto& source : read_placed_objects(document).materials) add(source.document, source.material);
    } else {
        ObjectReader root(document, document.root(), "the scene");
        for (const Value phase : needed(root, &FileParts::phases)) add(document, phase);
    }
    return opaque_phases(materials);
}

}  // namespace phasetree::tracer
