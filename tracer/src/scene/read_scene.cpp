#include <fmt/format.h>

#include <algorithm>

#include "phasetree/trace/tracer.hpp"
#include "scene/expectations.hpp"
#include "scene/file_parts.hpp"
#include "scene/find_emissive_parts.hpp"
#include "scene/image_parameters.hpp"
#include "scene/meshes_alone.hpp"
#include "scene/model_with_places.hpp"
#include "scene/nothing_left.hpp"
#include "scene/phase_entry.hpp"
#include "scene/read_parts.hpp"
#include "scene/unbounded_error.hpp"

namespace phasetree::tracer {

namespace {

// Settings of the image or the camera are easily written one level too high.
void refuse_misplaced_settings(ObjectReader& root) {
    for (const Value member : root.document().root()) {
        const std::string_view key = member.key();
        const auto refuse = [&](const char* part) {
            throw root.document().error(member.key_offset(),
                                        fmt::format("\"{}\" belongs in \"{}\", not in the scene itself", key, part));
        };
        ImageParameters::parameters([&](auto, const Parameter& p) {
            if (p.name == key) refuse("render");
        });
        for (const char* const name : {"position", "look_at", "fov"})
            if (key == name) refuse("camera");
    }
}

// Reads the parts of the file. None is required here, because a tree alone is useful, too; see needed().
FileParts parts_of(ObjectReader& root) {
    FileParts::parameters([&](auto, const auto& p) { root.allow({p.name}); });
    refuse_misplaced_settings(root);
    root.finish();
    FileParts parts;
    FileParts::parameters([&](auto part, const auto& p) { parts.*part = root.value(p.name); });
    return parts;
}

// Returns a part that this use of the file requires.
Value needed(ObjectReader& root, std::optional<Value> FileParts::*wanted) {
    std::string_view name;
    FileParts::parameters([&](auto part, const auto& p) {
        if (part == wanted) name = p.name;
    });
    return root.required_value(name);
}

// The location of the schema does not matter, but as the schema itself says, it must be a string.
void check_schema(const Document& document, const FileParts& parts) {
    if (parts.schema) (void)as<std::string>(document, *parts.schema, "\"$schema\"");
}

void check_version(const Document& document, Value version) {
    if (as<int>(document, version, "\"version\"") != 1)
        throw document.error(version, "\"version\" must be 1, the only version that phasetree reads");
}

Material read_phase_material(const Document& document, Value phase) {
    Material material = read_material_of_phase(document, phase);
    if (has_texture<MeshImageTexture>(material) || has_texture<MeshImageNumber>(material))
        throw document.error(phase,
                             "the texture \"mesh_image\" works only on meshes, because phases have no texture "
                             "coordinates; use \"image\"");
    if (has_texture<VertexColorTexture>(material))
        throw document.error(phase,
                             "the texture \"vertex_color\" works only on meshes, because phases have no vertices");
    if (is_thin(material) || has_two_sides(material))
        throw document.error(phase,
                             "a phase cannot be thin or two-sided, because light inside it would have no end; give the "
                             "material to a mesh, or use \"clear\" for glass with a thickness");
    if (normal_map_of(material))
        throw document.error(
            phase, "a \"normal_map\" works only on meshes, because phases have no texture coordinates; use a \"bump\"");
    return material;
}

// Counts the voxels of materials, which together must fit into the memory of a machine.
class VoxelBytes {
  public:
    // Throws SceneError at the phase whose material exceeds the limit.
    void add(const Document& document, Value phase, const Material& material) {
        constexpr std::size_t most = std::size_t{4} << 30;
        if (const Clear* clear = std::get_if<Clear>(&material))
            if (const auto* varying = std::get_if<VaryingMedium>(&clear->interior)) bytes_ += varying->bytes();
        if (bytes_ > most)
            throw document.error(phase, "the voxels of this phase and those before it need more than 4 GiB");
    }

  private:
    std::size_t bytes_ = 0;
};

// The lengths' unit, if the file declares one.
std::optional<LengthUnit> unit_of(const Document& document, const FileParts& parts) {
    if (!parts.unit) return std::nullopt;
    const auto name = as<std::string>(document, *parts.unit, "\"unit\"");
    if (const auto unit = length_unit_named(name)) return unit;
    throw document.error(*parts.unit,
                         fmt::format("\"unit\" must be {}, but is \"{}\"", names_of_length_units("\""), name));
}

void refuse_places_of_nothing(const Document& document) {
    for (const char* const part : {"instances", "groups"})
        if (const auto value = document.root().find(part))
            throw document.error(value->key_offset(), fmt::format("\"{}\" requires \"objects\"", part));
}

// What a file is read for. A picture needs a complete scene; a model needs only a tree or objects.
enum class Purpose { picture, model };

// Whether a file must have a version, and a material for each phase.
bool must_be_whole(const FileParts& parts, Purpose purpose) {
    return purpose == Purpose::picture || parts.camera;
}

void read_placed_into(const Document& document, const Shutter& shutter, NodePlaces* places, Purpose purpose,
                      Scene& scene, std::vector<ObjectsModel::Source>& materials) {
    ObjectsModel model = read_placed_objects(document, shutter, places);
    // A model is evaluated only at the document's time. Its objects are nevertheless read first for the whole time in
    // which the shutter is open, so that errors at any moment of it are reported.
    if (purpose == Purpose::model && (shutter.open != 0 || shutter.close != 0)) model = read_placed_objects(document);
    scene.phases = std::move(model.phases);
    scene.placed = std::move(model.placed);
    materials = std::move(model.materials);
}

void read_model_into(const Document& document, const FileParts& parts, const Shutter& shutter, NodePlaces* places,
                     Purpose purpose, Scene& scene) {
    std::vector<ObjectsModel::Source> materials;
    if (parts.objects) {
        read_placed_into(document, shutter, places, purpose, scene, materials);
    } else {
        refuse_places_of_nothing(document);
        if (has_meshes_alone(document)) {
            scene.object = object_beside_meshes_alone();
        } else {
            SceneTree tree = read_tree(document, file_readers(), places);
            scene.phases = std::move(tree.phases);
            scene.object = purpose == Purpose::picture ? with_bounds(tree.object) : std::move(tree.object);
            for (const Value phase : *parts.phases) materials.push_back({document, phase});
        }
    }
    scene.materials.push_back(vacuum());
    scene.densities.emplace_back();
    VoxelBytes voxels;
    for (const auto& [source, phase] : materials) {
        const PhaseEntry entry = phase_entry(source, phase);
        scene.densities.push_back(entry.parameters.density);
        const bool has_material =
            must_be_whole(parts, purpose) || (phase.is_object() && (entry.material || !entry.has_parameters));
        scene.materials.push_back(has_material ? read_phase_material(source, phase) : vacuum());
        voxels.add(source, phase, scene.materials.back());
    }
}

// Reads and checks all parts of a file. Every command uses this function, so an error for one command is an error for
// all.
Scene read_parts(const Document& document, Purpose purpose, NodePlaces* places) {
    ObjectReader root(document, document.root(), "the scene");
    const FileParts parts = parts_of(root);
    check_schema(document, parts);
    if (must_be_whole(parts, purpose) || parts.version) check_version(document, needed(root, &FileParts::version));

    Scene scene;
    scene.file = document.name();
    scene.unit = unit_of(document, parts);
    if (parts.render) scene.settings = read_settings(document, *parts.render, scene.film);
    const Shutter shutter{scene.settings.shutter.x, scene.settings.shutter.y};
    read_model_into(document, parts, shutter, places, purpose, scene);
    (void)read_expectations(document, {scene.phases, scene.unit ? scene.unit->metres : 1, scene.densities});
    scene.lights = read_lights(document, document.root());
    if (parts.meshes) {
        MeshGroup group = read_meshes(document, *parts.meshes, shutter);
        scene.meshes = std::move(group.meshes);
        scene.not_shown = std::move(group.not_shown);
    }
    if (purpose == Purpose::model && !parts.camera) return scene;
    const Value camera = needed(root, &FileParts::camera);
    scene.camera = read_camera(at_moment(document, shutter, 0), camera, scene.film);
    scene.camera_moments = read_camera_moments(document, camera, shutter);
    return scene;
}

SceneModel model_of(Scene scene) {
    return {std::move(scene.phases),
            std::move(scene.object),
            std::move(scene.placed),
            opaque_phases(scene.materials),
            scene.unit,
            std::move(scene.densities)};
}

}  // namespace

bool Scene::is_emissive() const {
    PhaseSet present = object ? phasetree::phases(object) : PhaseSet{};
    for (const PlacedObject& one : placed.objects) present = present | phasetree::phases(one.tree);
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (present.contains(static_cast<int>(i)) && tracer::is_emissive(materials[i])) return true;
    return std::ranges::any_of(meshes, [](const Mesh& mesh) { return tracer::is_emissive(mesh.material); });
}

bool Scene::moves() const {
    const auto mesh_moves = [](const Mesh& mesh) { return mesh.motion.has_value(); };
    return !camera_moments.empty() || !placed.moving.empty() || std::ranges::any_of(meshes, mesh_moves);
}

std::vector<std::string> object_names(const Scene& scene) {
    std::vector<std::string> names;
    if (scene.placed.empty()) names.emplace_back("object");
    for (const PlacedObject& object : scene.placed.objects) names.push_back(object.name);
    for (const Mesh& mesh : scene.meshes) names.push_back(mesh.name);
    return names;
}

Scene read_scene(const Document& document, NodePlaces* places) {
    Scene scene = read_parts(document, Purpose::picture, places);
    try {
        if (scene.object) (void)prepare_to_trace(scene.object);
        find_emissive_parts(scene);
    } catch (const ModelError& e) {
        throw object_error(document, document.root().find("tree").value_or(document.root()), e);
    }
    scene.lights.cluster_lamps();
    return scene;
}

SceneModel read_scene_without_camera(const Document& document) {
    return model_of(read_parts(document, Purpose::model, nullptr));
}

SceneModel read_scene_model(const Document& document) {
    SceneModel model = read_scene_without_camera(document.without_assets());
    refuse_meshes_alone(document);
    return model;
}

SceneModel read_scene_model(const Document& document, NodePlaces& places) {
    SceneModel model = model_of(read_parts(document.without_assets(), Purpose::model, &places));
    refuse_meshes_alone(document);
    return model;
}

PhaseSet opaque_phases(const std::vector<Material>& materials) {
    PhaseSet opaque;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (!is_clear(materials[i])) opaque = opaque | PhaseSet::of(Phase{static_cast<std::uint8_t>(i)});
    return opaque;
}

std::vector<std::optional<Material>> read_materials(const Document& document) {
    std::vector<std::optional<Material>> materials{vacuum()};
    VoxelBytes voxels;
    const auto add = [&](const Document& source, Value phase) {
        std::optional<Material>& material = materials.emplace_back();
        if (!phase.is_object()) return;
        if (const PhaseEntry entry = phase_entry(source, phase); entry.has_parameters && !entry.material) return;
        material = read_phase_material(source, phase);
        voxels.add(source, phase, *material);
    };
    if (has_objects(document)) {
        for (const auto& source : read_placed_objects(document).materials) add(source.document, source.material);
    } else {
        ObjectReader root(document, document.root(), "the scene");
        for (const Value phase : needed(root, &FileParts::phases)) add(document, phase);
    }
    return materials;
}

}  // namespace phasetree::tracer
