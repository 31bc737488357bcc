// Extensions of glTF: those of nodes, and messages about unsupported ones.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tracer/gltf/gltf_corner.hpp"

namespace test_gltf_extensions {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

std::string hidden(const std::string& visible) {
    return R"("extensions": {"KHR_node_visibility": {)" + visible + "}}";
}

}  // namespace

TEST_CASE("invisible nodes and their children are left out") {
    const auto file = [](const std::string& of_first, const std::string& of_child) {
        return Corner().file(R"("extensionsUsed": ["KHR_node_visibility"], "scenes": [{"nodes": [0, 2]}], "nodes": [
            {"mesh": 0, "children": [1], )" +
                             of_first + R"(}, {"mesh": 0, "translation": [0, 0, 1], )" + of_child +
                             R"(}, {"mesh": 0, "translation": [0, 0, 2]}], )" + meshes(all_attributes));
    };
    const auto heights = [](const gltf::GltfFile& found) {
        CHECK(found.not_shown.empty());
        std::vector<float> z;
        for (const glm::uvec3& t : found.parts.at(0).mesh.triangles) z.push_back(found.parts[0].mesh.vertices[t.x].z);
        return z;
    };
    const std::string visible = R"("visible": true)", invisible = R"("visible": false)";
    CHECK(heights(read(file(hidden(visible), hidden("")))) == std::vector<float>{0, 1, 2});
    CHECK(heights(read(file(hidden(""), hidden(invisible)))) == std::vector<float>{0, 2});
    CHECK(heights(read(file(hidden(invisible), hidden("")))) == std::vector<float>{2});
    // A visible child of an invisible node is hidden, too.
    CHECK(heights(read(file(hidden(invisible), hidden(visible)))) == std::vector<float>{2});
    CHECK(said(Corner().file(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, )" + hidden(invisible) + "}], " +
                             meshes(all_attributes))) ==
          "all of its meshes are hidden (KHR_node_visibility); make some visible and export it again");
}

TEST_CASE("joints bend skins even if their nodes are invisible") {
    Corner corner;
    corner.add("VEC4", 5121, 3, corner.bytes.add(std::vector<std::uint8_t>(12, 0)));
    corner.add("VEC4", 5126, 3, corner.bytes.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    const gltf::Part part =
        read(corner.file(
                 R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "skin": 0}, {"translation": [0, 0, 4], )" +
                 hidden(R"("visible": false)") + R"(}], "skins": [{"joints": [1]}], )" +
                 meshes(R"("attributes": {"POSITION": 0, "JOINTS_0": 5, "WEIGHTS_0": 6})")))
            .parts.at(0);
    CHECK(part.mesh.vertices.at(0).z == 4);
}

TEST_CASE("instances are where nodes with the same transforms are") {
    Corner corner;
    corner.add("VEC3", 5126, 2, corner.bytes.add(std::vector<float>{1, 0, 0, 0, 2, 0}));
    // Numbers from −1 to 1, stored in shorts and bytes.
    corner.add("VEC4", 5126, 2, corner.bytes.add(std::vector<float>{0, 0, 1, 0, 1, 0, 0, 0}));
    corner.add("VEC4", 5122, 2, corner.bytes.add(std::vector<std::int16_t>{0, 0, 32767, 0, 32767, 0, 0, 0}),
               R"(, "normalized": true)");
    corner.add("VEC4", 5120, 2, corner.bytes.add(std::vector<std::int8_t>{0, 0, 127, 0, 127, 0, 0, 0}),
               R"(, "normalized": true)");
    corner.add("VEC3", 5126, 2, corner.bytes.add(std::vector<float>{1, 2, 3, 0.5f, 0.5f, 0.5f}));
    const std::string parent = R"("translation": [0, 0, 7], "rotation": [0, 0.6, 0, 0.8], "scale": [1, 2, 1])";
    const gltf::Part nodes =
        read(corner.file(R"("scenes": [{"nodes": [0]}], "nodes": [{)" + parent + R"(, "children": [1, 2]},
            {"mesh": 0, "translation": [1, 0, 0], "rotation": [0, 0, 1, 0], "scale": [1, 2, 3]},
            {"mesh": 0, "translation": [0, 2, 0], "rotation": [1, 0, 0, 0], "scale": [0.5, 0.5, 0.5]}], )" +
                         meshes(all_attributes)))
            .parts.at(0);
    for (const char* const rotation : {"6", "7", "8"}) {
        CAPTURE(rotation);
        const gltf::GltfFile instances = read(corner.file(
            R"("extensionsUsed": ["EXT_mesh_gpu_instancing"], "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, )" +
            parent + R"(, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 5, "ROTATION": )" +
            rotation + R"(, "SCALE": 9}}}}], )" + meshes(all_attributes)));
        CHECK(instances.not_shown.empty());
        check_same(instances.parts.at(0), nodes);
    }
}

TEST_CASE("an extension that is required and not read is named, with what to do") {
    const auto said_of = [](const std::string& names) {
        return said(Corner().file("\"extensionsRequired\": [" + names + "], " + one_node + meshes(all_attributes)));
    };
    CHECK(said_of(R"("KHR_texture_transform", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility",
                     "KHR_materials_transmission", "KHR_lights_punctual", "KHR_xmp_json_ld")") == "read");
    CHECK(said_of(R"("EXT_texture_webp")") ==
          "it requires EXT_texture_webp, which phasetree cannot read; export the images as PNG or JPEG, or give the "
          "mesh a \"material\" here");
    CHECK(said_of(R"("KHR_meshopt_compression")") ==
          "it requires KHR_meshopt_compression, which phasetree cannot read; compress with EXT_meshopt_compression "
          "(gltfpack -c), or not at all");
    CHECK(said_of(R"("KHR_materials_unlit")") ==
          "it requires KHR_materials_unlit, which phasetree cannot read; export without it, or give the mesh a "
          "\"material\" here");
    const std::string of_material =
        Corner().file("\"extensionsRequired\": [\"KHR_materials_unlit\"], " + one_node + meshes(all_attributes));
    CHECK(gltf::read_gltf(of_material, gltf::ReadMaterials::none).not_shown.empty());
    CHECK(said_of(R"("ACME_teapot")") == "it requires ACME_teapot, which phasetree cannot read; export without it");
    // Messages quote only names.
    CHECK(said_of(R"("\u001b[2J")") == "it requires a glTF extension, which phasetree cannot read; export without it");
}

TEST_CASE("one sentence lists the extensions that are used and not read, and what is missing") {
    const auto sentences = [](const std::string& rest, gltf::ReadMaterials materials = gltf::ReadMaterials::all) {
        return gltf::read_gltf(Corner().file(one_node + meshes(all_attributes + ", \"material\": 0") + ", " + rest),
                               materials)
            .not_shown;
    };
    const std::string plain = R"("materials": [{}])";
    CHECK(sentences(plain).empty());
    CHECK(sentences(plain + R"(, "extensionsUsed": ["KHR_texture_transform", "KHR_xmp_json_ld", "KHR_materials_ior"])")
              .empty());
    CHECK(sentences(plain + R"(, "extensionsUsed": ["KHR_materials_unlit", "KHR_lights_punctual", "ACME_teapot",
                                "\u001b[2J", 7], "extensions": {"KHR_lights_punctual": {}})") ==
          std::vector<std::string>{
              "uses unsupported extensions: ACME_teapot (unknown), KHR_lights_punctual (missing: lights; add them to "
              "\"lights\"), KHR_materials_unlit (missing: unlit colours; surfaces are lit like others) and 2 more"});
    // Materials may have extensions that the document does not list.
    const std::string scattering = R"("materials": [{"extensions": {"KHR_materials_subsurface": {}}}])";
    CHECK(sentences(scattering) ==
          std::vector<std::string>{
              "uses unsupported extensions: KHR_materials_subsurface (missing: subsurface scattering)"});
    // They do not matter if the scene sets its own material.
    CHECK(sentences(scattering + R"(, "extensionsUsed": ["KHR_materials_subsurface", "EXT_texture_webp"])",
                    gltf::ReadMaterials::none)
              .empty());
    std::string many = "\"A\"";
    for (int i = 0; i < 99; ++i) many += ", \"ACME_" + std::to_string(i) + "\"";
    const auto long_list = sentences(plain + ", \"extensionsUsed\": [" + many + "]");
    REQUIRE(long_list.size() == 1);
    CHECK(long_list[0].ends_with(" and 80 more"));
}

}  // namespace test_gltf_extensions
