// Invalid glTF files, files that exceed limits, and the files that a document names.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/fingerprint.hpp"
#include "tracer/gltf/gltf_corner.hpp"
#include "tracer/support/paths.hpp"

namespace test_gltf_files {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("what is no glTF file, or is more than is read, is said") {
    const std::string good = Corner().file(one_node + meshes(all_attributes));
    CHECK(said(good) == "read");
    CHECK(said("") == "it is not a glTF file: it begins neither with \"glTF\" nor with a JSON document");
    CHECK(said(R"({"asset": {"version": "1.0"}})") == "it is not glTF version 2.0");
    CHECK(said(R"({"asset": {"version": "2.0", "minVersion": "2.1"}})") == "it is not glTF version 2.0");
    CHECK(said("\xEF\xBB\xBF {\"asset\": {\"version\": \"2.0\"}}") == "its scene has no triangles");
    CHECK(said("{\"asset\": \"\xE4\"}") == "its document is not valid JSON in UTF-8");
    CHECK(said(glb("\"x\": 1", "", 1)) == "it is not glTF version 2");
    const auto file = [](const std::string& rest) { return Corner().file(rest); };
    CHECK(said(file(R"("extensionsRequired": ["KHR_texture_transform", "KHR_materials_transmission"])")) ==
          "its scene has no triangles");
    CHECK(said(file(R"("scenes": [{"nodes": [7]}])")) == "scenes[0] refers to nodes[7], but there are only 0");
    CHECK(said(file(R"("scenes": [{"nodes": "all"}])")) == "scenes[0] must have a list \"nodes\"");
    CHECK(said(file(R"("scenes": [{"nodes": [0]}], "nodes": [{"scale": [1, 2]}])")) ==
          "nodes[0] must have 3 numbers in \"scale\"");
    CHECK(said(file(one_node + meshes(R"("attributes": {"NORMAL": 1})"))) ==
          "meshes[0].primitives[0] has no positions");
    CHECK(said(file(one_node + meshes(R"("attributes": {"POSITION": 2})"))) ==
          "accessors[2] has positions that do not have three numbers");
    CHECK(said(file(one_node + meshes(R"("attributes": {"POSITION": 0}, "indices": 0)"))) ==
          "accessors[0] has indices that are not whole numbers of at least 0");
    const auto accessor = [](const std::string& more) {
        Corner c;
        c.add("VEC3", 5126, 3, c.bytes.add(std::vector<float>(9, 0.5f)), more);
        return c.file(one_node + meshes(R"("attributes": {"POSITION": 5})"));
    };
    CHECK(said(accessor("")) == "read");
    CHECK(said(accessor(R"(, "byteOffset": 4)")) == "accessors[5] extends beyond the end of its bytes");
    Corner huge;
    huge.add("VEC3", 5126, 3, huge.bytes.add(std::vector<float>(9, 1e30f)));
    CHECK(said(huge.file(one_node + meshes(R"("attributes": {"POSITION": 5})"))).find("beyond 10") !=
          std::string::npos);
    Corner dark;
    dark.add("VEC3", 5126, 3, dark.bytes.add(std::vector<float>(9, std::nanf(""))));
    CHECK(said(dark.file(one_node + meshes(R"("attributes": {"POSITION": 0, "COLOR_0": 5})")))
              .find("accessors[5] has a value that is not a number") == 0);
    CHECK(
        said(
            glb(R"("bufferViews": [{"buffer": 1, "byteLength": 4}], "accessors": [{"bufferView": 0, "componentType": 5126,
        "count": 1, "type": "VEC3"}], )" +
                    one_node + meshes(R"("attributes": {"POSITION": 0})"),
                "    "))
            .find("bufferViews[0] refers to buffers[1], but there are only 1") == 0);
}

TEST_CASE("buffers and images may be written into the document, or be files in its folder") {
    // The triangle (0, 0, 0) (1, 0, 0) (0, 1, 0), as 36 bytes.
    const std::vector<float> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(numbers.data()), 36);
    const std::string in_base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const auto document = [](const std::string& uri) {
        return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": ")" + uri + R"("}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126,
            "count": 3, "type": "VEC3"}], )" +
               one_node + meshes(R"("attributes": {"POSITION": 0}, "material": 0)") + R"(, "materials": [
            {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
            "images": [{"uri": "maps/white%20paint.png"}]})";
    };
    std::vector<std::string> asked;
    const auto files = [&](const std::string& path) {
        asked.push_back(path);
        return path.ends_with(".png") ? png(std::vector<unsigned char>(12, 255)) : bytes;
    };
    const auto read_by = [&](const std::string& content, const gltf::ReadFile& read_file) {
        asked.clear();
        return gltf::read_gltf(content, gltf::ReadMaterials::all, {}, read_file);
    };
    for (const std::string& uri : {"data:application/octet-stream;base64," + in_base64, std::string("a.bin")}) {
        CAPTURE(uri);
        const gltf::GltfFile file = read_by(document(uri), files);
        CHECK(file.parts.at(0).mesh.vertices == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(std::get<Glowing>(file.parts[0].material).radiance == 1);
        CHECK(asked.back() == "maps/white paint.png");
    }
    CHECK(asked == std::vector<std::string>{"a.bin", "maps/white paint.png"});
    CHECK(gltf::Document(document("a%2Ebin"), files).files() ==
          std::vector<std::string>{"a.bin", "maps/white paint.png"});
    // Data as plain text, and folders with Windows separators.
    CHECK(gltf::bytes_of_uri("data:,a%20b", {}) == "a b");
    CHECK(gltf::bytes_of_uri("data:;base64,Zm9v", {}) == "foo");
    CHECK(gltf::bytes_of_uri("data:;base64,Zm8=", {}) == "fo");
    CHECK(gltf::bytes_of_uri("DATA:;Base64,Z\nm8%3D", {}) == "fo");
    CHECK(gltf::path_of_uri("maps\\a.png") == "maps/a.png");
    CHECK(gltf::path_of_uri("50%.png") == "50%.png");
    const auto refused = [&](const std::string& uri) {
        try {
            (void)read_by(document(uri), files);
        } catch (const gltf::GltfError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK(refused("C:/a.bin").find("is outside the folder of the document") != std::string::npos);
    CHECK(refused("https://example.org/a.bin") ==
          "buffers[0] is outside the folder of the document; files are never downloaded");
    for (const char* const uri : {"../a.bin", "a/%2e%2e/../b.bin", "/etc/passwd", "", "a%00.bin", "..\\\\a.bin"}) {
        CAPTURE(uri);
        CHECK(refused(uri) == "buffers[0] must name a file in the folder of the document or in a subfolder");
    }
    CHECK(refused("data:;base64") == "buffers[0] has no comma before its data");
    CHECK(refused("data:;base64,!!!!") == "buffers[0] has data that are not valid base64");
    CHECK(said(document("a.bin")) == "buffers[0] is in a separate file");
}

TEST_CASE("a scene reads a .gltf file with what is in its folder, and nothing that a link leads to elsewhere") {
    const phasetree::support::TemporaryDirectory folder, elsewhere;
    const std::vector<float> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(numbers.data()), 36);
    const auto write = [&](const std::string& uri) {
        phasetree::support::write_text(
            folder / "a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": ")" + uri +
                                   R"("}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126,
            "count": 3, "type": "VEC3"}], )" +
                                   one_node + meshes(R"("attributes": {"POSITION": 0})") + "}");
    };
    const auto scene = [&] {
        return scene_of(R"("a": {"diffuse": {"color": [1, 1, 1]}})",
                        R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})",
                        std::string(white_environment) + R"(, "meshes": [{"gltf": {"file": ")" +
                            (folder / "a.gltf").string() + "\"}}]");
    };
    const auto problem = [&] {
        try {
            (void)scene();
        } catch (const phasetree::SceneError& e) {
            return std::string(e.message());
        }
        return std::string();
    };
    std::filesystem::create_directory(folder / "parts");
    phasetree::support::write_text(folder / "parts/a.bin", bytes);
    write("parts/a.bin");
    CHECK(scene().meshes.at(0).vertices.size() == 3);
    write("parts/b.bin");
    CHECK(problem().find("a.gltf: buffers[0] cannot be read: no such file") != std::string::npos);
    phasetree::support::write_text(elsewhere / "c.bin", bytes);
    std::filesystem::create_symlink(elsewhere / "c.bin", folder / "parts/c.bin");
    write("parts/c.bin");
    CHECK(problem().find("parts/c.bin is outside the folder of") != std::string::npos);
    // Files that the document names are part of the scene's identity, so that parts of a picture show the same scene.
    const auto identity = [&] {
        return fingerprint(phasetree::Document::from_text(
            R"({"version": 1, "meshes": [{"gltf": {"file": ")" + (folder / "a.gltf").string() + "\"}}]}",
            "scene.json"));
    };
    write("parts/a.bin");
    const auto before = identity();
    CHECK(identity() == before);
    phasetree::support::write_text(folder / "parts/a.bin", bytes + " ");
    CHECK(identity() != before);
    // With an extension in upper or lower case, and beside an image that is not read.
    const auto changes = [&](const std::string& name, const std::string& content) {
        phasetree::support::write_text(folder / name, content);
        const auto identity_of = [&] {
            return fingerprint(phasetree::Document::from_text(
                R"({"version": 1, "meshes": [{"gltf": {"file": ")" + (folder / name).string() + "\"}}]}",
                "scene.json"));
        };
        phasetree::support::write_text(folder / "parts/a.bin", bytes);
        const auto first = identity_of();
        phasetree::support::write_text(folder / "parts/a.bin", bytes + " ");
        return identity_of() != first;
    };
    const std::string named = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "parts/a.bin"}])";
    CHECK(changes("b.GLTF", named + "}"));
    CHECK(changes("c.gltf", named + R"(, "images": [{"uri": "https://example.org/a.png"}, {"uri": "../b.png"}]})"));
    CHECK(changes("e.gltf", named + R"(, "images": [1, {"uri": 2}]})"));
    const std::string all = phasetree::tests::glb_chunk(0x4E4F534A, named + "}", ' ');
    const std::uint32_t head[3] = {0x46546C67, 2, static_cast<std::uint32_t>(12 + all.size())};
    CHECK(changes("d.glb", std::string(reinterpret_cast<const char*>(head), sizeof head) + all));
}

TEST_CASE("every shortened file, and every file with a wrong number in it, is read or refused") {
    Corner corner;
    const std::size_t view = corner.add_view(png({255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128}));
    const std::string good = corner.file(
        R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "scale": [1, 2, 3]}, {"children": [2]}, {"mesh": 0}], )" +
        meshes(all_attributes + R"(, "material": 0, "mode": 4)") + R"(, "materials": [{"pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}], "textures": [{"source": 0}], "images": [{"bufferView": )" +
        std::to_string(view) + "}]");
    REQUIRE(said(good) == "read");
    std::size_t refused = 0;
    for (std::size_t n = 0; n < good.size(); n += 3) refused += said(good.substr(0, n)) != "read";
    CHECK(refused > 100);
    refused = 0;
    // Each digit of the document becomes each of a few others, and each letter a digit.
    const std::size_t end = good.find("BIN");
    for (std::size_t at = 20; at < end; ++at)
        for (const char other : {'0', '9', '-', '"', '{'}) {
            std::string changed = good;
            changed[at] = other;
            refused += said(changed, {.triangles = 1000}) != "read";
        }
    CHECK(refused > 1000);
    // Nodes in cycles, and a node with two parents.
    CHECK(said(Corner().file(R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}])")) ==
          "nodes[0] occurs twice in the node hierarchy");
    // A mesh that is placed twice counts twice.
    const std::string twice = Corner().file(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0}], )" +
                                            meshes(all_attributes));
    CHECK(said(twice, {.triangles = 2}) == "read");
    CHECK(said(twice, {.triangles = 1}) == "it has more than 0 million triangles");
    Corner doubled;
    doubled.add("SCALAR", 5121, 6, doubled.bytes.add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 0}));
    const std::string both = doubled.file(one_node + meshes(R"("attributes": {"POSITION": 0}, "indices": 5)"));
    CHECK(said(both, {.triangles = 2}) == "read");
    // Too many materials, pixels or brackets.
    const std::string two =
        Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes + R"(, "material": 0}, {)" +
                      all_attributes + R"(, "material": 1}]}], "materials": [{}, {}])");
    CHECK(said(two, {.primitives = 2}) == "read");
    CHECK(said(two, {.primitives = 1}) == "it has more than 1 primitives");
    CHECK(said(two, {.materials = 2}) == "read");
    CHECK(said(two, {.materials = 1}) == "it has more than 1 materials");
    CHECK(said(good, {.pixels = 4}) == "read");
    CHECK(said(good, {.pixels = 3}) == "its images have more than 0 million pixels in total");
    CHECK(said(glb("\"x\": " + std::string(10'000'000, '['), "")) ==
          "its JSON document is nested more than 64 levels deep");
    // Many unused elements, and many that name the same node, take no time.
    std::string many;
    for (int i = 0; i < 1'000'000; ++i) many += i > 0 ? ",{}" : "{}";
    CHECK(said(Corner().file(one_node + meshes(all_attributes) + R"(, "extras": [)" + many + "]")) == "read");
    std::string same = "1";
    for (int i = 0; i < 1'000'000; ++i) same += ",1";
    CHECK(said(Corner().file(R"("scenes": [{"nodes": [)" + same + R"(]}], "nodes": [{}, {}])")) ==
          "nodes[1] occurs twice in the node hierarchy");
    const std::string deep = "\"x\": " + std::string(60, '[') + std::string(60, ']');
    CHECK(said(Corner().file(one_node + meshes(all_attributes) + ", " + deep)) == "read");
    CHECK(said(both, {.triangles = 1}) == "it has more than 0 million triangles");
}

}  // namespace test_gltf_files
