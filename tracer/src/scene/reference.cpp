#include "scene/reference.hpp"

#include "lights/light_kinds.hpp"
#include "scene/camera_kinds.hpp"
#include "scene/file_parts.hpp"
#include "scene/image_parameters.hpp"
#include "scene/material_kinds.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/object_kinds.hpp"
#include "shading/normal_map.hpp"

namespace phasetree::tracer {

namespace {

// The kinds that a mesh may have.
template <class... Kinds>
std::vector<KindPage> pages_of_opaque(TypeList<Kinds...>) {
    std::vector<KindPage> pages;
    const auto add_opaque = [&]<class Kind>(const Kind*) {
        if constexpr (!std::is_same_v<decltype(std::declval<Kind>().made()), Clear>) pages.push_back(page_of<Kind>());
    };
    (add_opaque(static_cast<const Kinds*>(nullptr)), ...);
    return pages;
}

// A single transform, a list of them, or keys.
std::string schema_of_transform(const std::string& one) {
    return R"({"anyOf": [)" + one + R"(, {"type": "array", "minItems": 1, "items": )" + one + "}, " +
           schema_reference("keys") + "]}";
}

}  // namespace

std::vector<Chapter> scene_chapters() {
    std::vector<Chapter> chapters{
        {"Scene file",
         "A scene is JSON with comments. z is up; lengths are in any one unit, which is called m here; colours are "
         "linear `[r, g, b]` or sRGB `\"#rrggbb\"`. Instead of any number that need not be whole, vector or colour "
         "there may be `{\"keys\": [[seconds, value], …]}`: it changes with time, linearly between its keys, or with "
         "`\"between\": \"smooth\"` slowly at both ends. A picture shows what is there at its time. While the shutter "
         "is open, the camera and the transforms of objects and instances go on, and are blurred; all else stays.",
         {page_of<FileParts>()}}};
    chapters.push_back({"Objects and instances",
                        "A scene of several objects has \"objects\", and places them by \"instances\" and \"groups\".",
                        {page_of<ObjectParameters>(), page_of<InstanceParameters>()}});
    chapters.push_back(
        {"Transforms",
         "Where an object or an instance stands: one of these nodes' maps, or a list of them, of which "
         "the first comes first. It moves with `{\"keys\": [[seconds, transform], …]}`: between two keys the "
         "origin goes straight, scales change evenly, and it turns the shorter way, so a turn of more "
         "than half a circle needs a key on its way, or an angle that has keys.",
         pages_of(TransformKinds())});
    for (Chapter& chapter : node_chapters()) chapters.push_back(std::move(chapter));
    chapters.push_back(
        {"Materials", "A phase or a mesh is of one material, `{\"kind\": {parameters}}`.", pages_of(MaterialKinds())});
    chapters.push_back(
        {"Textures",
         "A material's colour may be a texture, which is a colour for each point of space: that of a whole "
         "tree. Nodes that move or bend a part of the tree do not take the texture along: a field that a "
         "colour follows must be moved in the same way. What is an object of \"objects\", or an instance "
         "of one, takes its textures along.",
         pages_of(NamedTextures())});
    chapters.push_back({"Numbers",
                        "A material's roughness, and the thickness of a film on it, may be another at each point.",
                        pages_of(NumberTextures())});
    chapters.push_back({"Maps of normals",
                        "An opaque material of a mesh may have one, `\"normal_map\": {parameters}`.",
                        {page_of<NormalMap>()}});
    chapters.push_back(
        {"Voxels",
         "They tell densities and temperatures of the medium of a clear material: `\"density_grid\": {parameters}` "
         "and `\"temperature_grid\": {parameters}`.",
         {page_of<Voxels>()}});
    chapters.push_back({"Lights", "Radiances have no unit. Those of all lights and the exposure belong together.",
                        pages_of(LightKinds())});
    chapters.push_back({"Meshes", "What stands beside the object. Meshes are opaque.", pages_of(MeshKinds())});
    chapters.push_back(
        {"Cameras",
         "Where the image is taken from: `{\"kind\": {parameters}}`, or the parameters of a thin lens alone.",
         pages_of(CameraKinds())});
    chapters.push_back({"Image", "How large the image is, and how it is made.", {page_of<ImageParameters>()}});
    return chapters;
}

std::string scene_reference_text() {
    return reference_text(scene_chapters());
}

std::string scene_reference_markdown() {
    return "# Scene files\n\nAll that a scene file can say, written by `phasetree nodes --markdown` from the program's "
           "own lists of parameters. Sections are the paper's. A node's picture leads to the tree that it shows; "
           "[nodes/studio.json](nodes/studio.json) is the scene around it, and [nodes/render.sh](nodes/render.sh) "
           "takes "
           "the pictures.\n" +
           reference_markdown(scene_chapters());
}

std::string scene_json_schema() {
    const std::pair<std::string, std::string> definitions[] = {
        {"colour", colour_type(limits::non_negative).schema},
        {"texture", schema_of_either(colour_type(limits::fraction).schema, schema_of_one(pages_of(NamedTextures())))},
        {"number_texture", schema_of_one(pages_of(NumberTextures()))},
        {"normal_map", schema_of(page_of<NormalMap>())},
        {"voxels", schema_of(page_of<Voxels>())},
        {"material", schema_of_one(pages_of(MaterialKinds()))},
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
