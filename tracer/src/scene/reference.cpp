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
         "A scene is JSON with comments. z is up. Lengths may be in any one unit, which is called m here. Colours are "
         "linear `[r, g, b]` or sRGB `\"#rrggbb\"`. Numbers that need not be whole, vectors and colours can be "
         "animated with `{\"keys\": [[seconds, value], …]}`: the value changes linearly between keys, or, with "
         "`\"between\": \"smooth\"`, slowly near them. A picture shows the scene at one time. While the shutter is "
         "open, the camera and the transforms of objects and instances keep moving, which blurs them; everything else "
         "stands still.",
         {page_of<FileParts>()}}};
    chapters.push_back({"Objects and instances",
                        "A scene of several objects has \"objects\", which \"instances\" and \"groups\" place.",
                        {page_of<ObjectParameters>(), page_of<InstanceParameters>()}});
    chapters.push_back({"Transforms",
                        "The transform of an object or an instance: one of these nodes, or a list of them, applied in "
                        "order. It can be animated with `{\"keys\": [[seconds, transform], …]}`: between two keys the "
                        "origin moves in a straight line, scales change linearly, and rotations take the shorter way. "
                        "A turn of more than half a circle therefore needs a key in between, or an angle with keys.",
                        pages_of(TransformKinds())});
    for (Chapter& chapter : node_chapters()) chapters.push_back(std::move(chapter));
    chapters.push_back({"Materials", "Each phase and each mesh has one material, `{\"kind\": {parameters}}`.",
                        pages_of(MaterialKinds())});
    chapters.push_back(
        {"Textures",
         "A material's colour may be a texture, which has a colour for each point in the space of the whole tree. "
         "Nodes that move or deform a part of the tree do not move the texture. If a colour follows a field, move the "
         "field in the same way. An object of \"objects\" and its instances do carry their textures along.",
         pages_of(NamedTextures())});
    chapters.push_back({"Numbers", "A material's roughness and the thickness of its film may vary from point to point.",
                        pages_of(NumberTextures())});
    chapters.push_back({"Normal maps",
                        "An opaque material of a mesh may have a normal map, `\"normal_map\": {parameters}`.",
                        {page_of<NormalMap>()}});
    chapters.push_back({"Voxels",
                        "Densities and temperatures of the medium in a clear material: `\"density_grid\": "
                        "{parameters}` and `\"temperature_grid\": {parameters}`.",
                        {page_of<Voxels>()}});
    chapters.push_back(
        {"Lights", "Radiances have no unit: only their ratios and the exposure matter.", pages_of(LightKinds())});
    chapters.push_back({"Meshes", "Opaque meshes beside the object.", pages_of(MeshKinds())});
    chapters.push_back({"Cameras", "The camera, `{\"kind\": {parameters}}`, or only the parameters of a thin lens.",
                        pages_of(CameraKinds())});
    chapters.push_back({"Image", "Size of the image and settings of the renderer.", {page_of<ImageParameters>()}});
    return chapters;
}

std::string scene_reference_text() {
    return reference_text(scene_chapters());
}

std::string scene_reference_markdown() {
    return "# Scene files\n\nThe complete reference of the scene format, written by `phasetree nodes --markdown` from "
           "the program's own lists of parameters. Section numbers refer to the paper. The picture of a node links to "
           "its tree; [nodes/studio.json](nodes/studio.json) is the scene around it, and "
           "[nodes/render.sh](nodes/render.sh) renders the pictures.\n" +
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
