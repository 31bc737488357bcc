#include "scene/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lights/light_kinds.hpp"
#include "scene/camera_kinds.hpp"
#include "scene/expectation_kinds.hpp"
#include "scene/file_parts.hpp"
#include "scene/image_parameters.hpp"
#include "scene/length_unit.hpp"
#include "scene/material_kinds.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/object_kinds.hpp"
#include "scene/phase_entry.hpp"
#include "scene/phase_function_kinds.hpp"
#include "shading/normal_map.hpp"

namespace phasetree::tracer {

namespace {

// The kinds of materials that a mesh may have.
template <class... Kinds>
std::vector<KindPage> pages_of_opaque(TypeList<Kinds...>) {
    std::vector<KindPage> pages;
    const auto add_opaque = [&]<class Kind>(const Kind*) {
        if constexpr (!std::is_same_v<decltype(std::declval<Kind>().made()), Clear>) pages.push_back(page_of<Kind>());
    };
    (add_opaque(static_cast<const Kinds*>(nullptr)), ...);
    return pages;
}

template <class... Kinds>
std::vector<std::string_view> names_for_meshes_only(TypeList<Kinds...>) {
    std::vector<std::string_view> names;
    const auto add = [&]<class Kind>(const Kind*) {
        if constexpr (requires { Kind::for_meshes_only; }) names.push_back(Kind::info.name);
    };
    (add(static_cast<const Kinds*>(nullptr)), ...);
    return names;
}

// A single transform, a list of them, or keys.
std::string schema_of_transform(const std::string& one) {
    return R"({"anyOf": [)" + one + R"(, {"type": "array", "minItems": 1, "items": )" + one + "}, " +
           schema_reference("keys") + "]}";
}

std::string schema_of_length_unit() {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const LengthUnit& unit : length_units) names.push_back(unit.name);
    return nlohmann::ordered_json{{"enum", names}}.dump();
}

// A material, or parameters of the phase with or without a material beside them.
std::string schema_of_phase() {
    using Json = nlohmann::ordered_json;
    Json properties = Json::parse(schema_of(page_of<PhaseParameters>()))["properties"], parameters = Json::array();
    for (const auto& [name, schema] : properties.items()) parameters.push_back(name);
    for (const KindPage& kind : pages_of(MaterialKinds()))
        properties[kind.name] = {{"$ref", fmt::format("#/definitions/material/properties/{}", kind.name)}};
    const Json with_parameters{{"type", "object"},
                               {"required", parameters},
                               {"maxProperties", parameters.size() + 1},
                               {"additionalProperties", false},
                               {"properties", properties}};
    return schema_of_either(schema_reference("material"), with_parameters.dump());
}

// An example of the reference, without the line feed at its end.
std::string example_text(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in || text.empty())
        throw std::runtime_error(
            fmt::format("{}: cannot read this example; every kind needs one, of members of a scene", file.string()));
    text.erase(text.find_last_not_of(" \n") + 1);
    return text;
}

}  // namespace

std::vector<std::string_view> materials_for_meshes_only() {
    return names_for_meshes_only(MaterialKinds());
}

std::vector<Chapter> scene_chapters() {
    std::vector<Chapter> chapters{
        {"Scene file",
         "A scene is JSON with comments. z is up. Lengths are in one unit of your choice, called m here. Colours are "
         "linear `[r, g, b]` or sRGB `\"#rrggbb\"`.\n\n"
         "Numbers that need not be whole, vectors and colours may change with time: `{\"keys\": [[seconds, value], "
         "…]}` is interpolated linearly between the keys, or slowly at both ends with `\"between\": \"smooth\"`. A "
         "picture shows the scene at its time. While the shutter is open, only the camera, the transforms of objects "
         "and "
         "instances, and the placements of meshes change, and motion is blurred.",
         {page_of<FileParts>()}}};
    chapters.push_back({"Placed objects",
                        "A scene of several objects has `\"objects\"`, and places them by `\"instances\"` and "
                        "`\"groups\"`.",
                        {page_of<ObjectParameters>(), page_of<InstanceParameters>()}});
    chapters.push_back(
        {"Transforms",
         "The place of an object or an instance: one of these maps, or a list of them, applied in order. It moves with "
         "`{\"keys\": [[seconds, transform], …]}`. Between two keys the origin moves along a straight line, scales "
         "change evenly, and rotations take the shorter way. For more than half a turn, add a key in between, or give "
         "the angle keys of its own.",
         pages_of(TransformKinds())});
    for (Chapter& chapter : node_chapters()) chapters.push_back(std::move(chapter));
    chapters.push_back({"Materials", "Each phase and each mesh has one material, `{\"kind\": {parameters}}`.",
                        pages_of(MaterialKinds())});
    chapters.push_back(
        {"Textures",
         "A texture may replace a material's colour. It is a colour for each point in the space of the whole tree: "
         "nodes that move or bend a part of the tree do not move the texture. If a colour follows a field, move that "
         "field in the same way. Objects of `\"objects\"` and their instances take their textures along.",
         pages_of(NamedTextures())});
    chapters.push_back({"Number textures",
                        "The roughness of a material, the thickness of its film, the amount of a mixture and the "
                        "opacity of a mesh may vary from point to point.",
                        pages_of(NumberTextures())});
    chapters.push_back({"Normal maps",
                        "An opaque material of a mesh may have one: `\"normal_map\": {parameters}`.",
                        {page_of<NormalMap>()}});
    chapters.push_back({"Phase functions",
                        "How the medium in a clear material scatters light: `\"phase_function\": {\"kind\": "
                        "{parameters}}`. In the equations, μ is the cosine of the angle by which light is turned.",
                        pages_of(PhaseFunctionKinds())});
    chapters.push_back({"Voxel grids",
                        "Grids set the density and the temperature of the medium in a clear material: "
                        "`\"density_grid\": {parameters}` "
                        "and `\"temperature_grid\": {parameters}`.",
                        {page_of<Voxels>()}});
    chapters.push_back({"Lights",
                        "Radiance has no fixed unit: what counts is the radiance of each light relative to the others "
                        "and to the exposure.",
                        pages_of(LightKinds())});
    chapters.push_back(
        {"Meshes", "Meshes are in the scene in addition to the object. They have no interior, so none is \"clear\".",
         pages_of(MeshKinds())});
    chapters.push_back({"Cameras",
                        "`\"camera\"` is `{\"kind\": {parameters}}`. The parameters of a thin lens may stand alone.",
                        pages_of(CameraKinds())});
    chapters.push_back(
        {"Render settings", "The size of the picture, and how it is rendered.", {page_of<ImageParameters>()}});
    chapters.push_back(
        {std::string(chapter_without_pictures),
         "Statements in `\"expect\"`, `{\"kind\": {parameters}}`, which `phasetree check --prove` proves "
         "or refutes. Lengths are in the scene's unit. Every statement also requires its phases to be "
         "present. A phase may be the \"vacuum\", except in \"closed\", \"wall\", \"volume\" and "
         "\"mass\".",
         pages_of(ExpectationKinds())});
    for (Chapter& chapter : chapters)
        for (KindPage& page : chapter.pages)
            if (page.example.empty() && chapter.title != chapter_without_pictures)
                page.example = fmt::format("{}/{}", file_stem(chapter), page.name);
    return chapters;
}

std::string scene_reference_text() {
    return reference_text(scene_chapters());
}

std::vector<ReferencePage> scene_reference_pages(const std::filesystem::path& folder) {
    const std::vector<Chapter> nodes = node_chapters();
    std::vector<Chapter> chapters = scene_chapters();
    std::vector<ReferencePage> pages{
        {"README.md",
         "# Scene reference\n\nEverything that a scene file can contain, with pictures, units, limits and defaults. "
         "`phasetree nodes --markdown scenes/reference` writes these pages from the lists of parameters that the "
         "program's readers use; `phasetree nodes` prints the same text. [Scene "
         "files](../../tracer/manual/reference/scene-files.md) explains how a file is organised.\n\n"
         "Each picture links to its example. The example of a node is a tree, shown in the "
         "[studio](../nodes/studio.json). Other examples are members of a scene: `render.py` "
         "adds the rest from a `studio.json`, and renders them. Sections are those of the paper.\n\n" +
             reference_index(chapters)}};
    for (Chapter& chapter : chapters) {
        chapter.text += "\n\nAll chapters: [scene reference](README.md).";
        const bool is_of_nodes = std::ranges::find(nodes, chapter.title, &Chapter::title) != nodes.end();
        for (KindPage& page : chapter.pages)
            if (!is_of_nodes && !page.example.empty()) page.snippet = example_text(folder / (page.example + ".json"));
        pages.push_back({file_stem(chapter) + ".md", reference_markdown(chapter)});
    }
    return pages;
}

std::string scene_json_schema() {
    const std::pair<std::string, std::string> definitions[] = {
        {"colour", colour_type(limits::non_negative).schema},
        {"texture", schema_of_either(colour_type(limits::fraction).schema, schema_of_one(pages_of(NamedTextures())))},
        {"number_texture", schema_of_one(pages_of(NumberTextures()))},
        {"normal_map", schema_of(page_of<NormalMap>())},
        {"phase_function", schema_of_one(pages_of(PhaseFunctionKinds()))},
        {"voxels", schema_of(page_of<Voxels>())},
        {"material", schema_of_one(pages_of(MaterialKinds()))},
        {"unit", schema_of_length_unit()},
        {"expectation", schema_of_one(pages_of(ExpectationKinds()))},
        {"phase", schema_of_phase()},
        {"opaque_material", schema_of_one(pages_of_opaque(MaterialKinds()))},
        {"light", schema_of_one(pages_of(LightKinds()))},
        {"mesh", schema_of_one(pages_of(MeshKinds()))},
        {"transform", schema_of_transform(schema_of_one(pages_of(TransformKinds())))},
        {"placed_object", schema_of(page_of<ObjectParameters>())},
        {"instance", schema_of(page_of<InstanceParameters>())},
        {"camera", schema_of_either(schema_of(page_of<ThinLensKind>()), schema_of_one(pages_of(CameraKinds())))},
        {"render", schema_of(page_of<ImageParameters>())}};
    return scene_schema(page_of<FileParts>(), definitions);
}

}  // namespace phasetree::tracer
