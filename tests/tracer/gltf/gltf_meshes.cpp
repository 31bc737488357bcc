// Meshes from glTF files: their placement and their parts.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tracer/gltf/gltf_corner.hpp"
#include "tracer/support/paths.hpp"

namespace test_gltf_meshes {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("nodes place meshes by matrices and by parts, and those of others in them") {
    const std::string placed = R"("scenes": [{"nodes": [0]}], "nodes": [
        {"translation": [10, 0, 0], "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 1, 1], "children": [1, 2]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 5, 1]},
        {"mesh": 0}], )";
    const gltf::Part part = read(Corner().file(placed + meshes(all_attributes))).parts.at(0);
    REQUIRE(part.mesh.triangles.size() == 2);
    REQUIRE(part.mesh.vertices.size() == 6);
    // Computed by hand: the matrix rotates y to z and moves up by 5. The parent stretches x, maps x to y and y to −x,
    // and moves.
    CHECK(is_near(part.mesh.vertices[0], {10, 0, 5}));
    CHECK(is_near(part.mesh.vertices[1], {10, 2, 5}));
    CHECK(is_near(part.mesh.vertices[2], {10, 0, 6}));
    CHECK(is_near(part.mesh.vertices[4], {10, 2, 0}));
    CHECK(is_near(part.mesh.vertices[5], {9, 0, 0}));
    // A normal that leans along x leans half as much along the stretched x.
    CHECK(is_near(part.normals.values[5], glm::normalize(glm::vec3(0, 0.3f, 0.8f))));
    CHECK(is_near(part.colors.values[4], {0, 1, 0}));
    CHECK(said(Corner().file(R"("nodes": [{"mesh": 0}], )" + meshes(all_attributes))) == "its scene has no triangles");
}

TEST_CASE("triangles of all modes and all types of indices") {
    const auto square = [](const std::string& how, int type, const std::string& view) {
        Corner c;
        GlbBytes& bytes = c.bytes;
        // Rows of five floats; the first three are the position.
        c.add("VEC3", 5126, 4,
              bytes.add(std::vector<float>{0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9, 9, 1, 1, 0, 9, 9},
                        ", \"byteStride\": 20"));
        if (type == 5121)
            c.add("SCALAR", type, 4, bytes.add(std::vector<std::uint8_t>{0, 1, 2, 3}));
        else if (type == 5125)
            c.add("SCALAR", type, 6, bytes.add(std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
        return read(c.file(one_node + meshes(R"("attributes": {"POSITION": 5})" + how) + view)).parts.at(0);
    };
    const auto area = [](const gltf::Part& part) {
        glm::vec3 sum(0);
        for (const glm::uvec3& t : part.mesh.triangles)
            sum += 0.5f * glm::cross(part.mesh.vertices[t.y] - part.mesh.vertices[t.x],
                                     part.mesh.vertices[t.z] - part.mesh.vertices[t.x]);
        return sum;
    };
    CHECK(is_near(area(square(R"(, "indices": 6)", 5125, "")), {0, 0, 1}));
    CHECK(is_near(area(square(R"(, "indices": 6, "mode": 5)", 5121, "")), {0, 0, 1}));
    // A fan about the first corner covers the first half, and half of the square on its other side.
    CHECK(is_near(area(square(R"(, "mode": 6)", 0, "")), {0, 0, 0}));
    CHECK(square(R"(, "mode": 6)", 0, "").mesh.triangles.size() == 2);
    CHECK(square(R"(, "mode": 5)", 0, "").mesh.triangles.size() == 2);
    CHECK(is_near(area(square("", 0, "")), {0, 0, 0.5f}));  // three of the four corners are a triangle
    CHECK(square("", 0, "").normals.empty());
    const gltf::GltfFile lines = read(Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes +
                                                    "}, {" + all_attributes + R"(, "mode": 1}]}])"));
    CHECK(lines.parts.at(0).mesh.triangles.size() == 1);
    CHECK(lines.not_shown.back() == "has points or lines, which are ignored");
}

TEST_CASE(
    "parts have names of their own, vertices that no triangle has are not taken, and what is passed over is said") {
    Corner corner;
    corner.add("SCALAR", 5121, 3, corner.bytes.add(std::vector<std::uint8_t>{2, 1, 2}));
    const gltf::GltfFile file = read(corner.file(
        R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": [5, 0, 0]}], "animations": [{}],
           "meshes": [{"primitives": [{)" +
        all_attributes +
        R"(, "material": 0}, {"attributes": {"POSITION": 0}, "indices": 5, "material": 1}]}],
           "materials": [{"name": "wood"}, {"name": "wood"}], "extensions": {"KHR_lights_punctual": {}})"));
    REQUIRE(file.parts.size() == 2);
    CHECK(file.parts[0].name == "wood");
    CHECK(file.parts[1].name == "wood 2");
    CHECK(file.parts[1].mesh.vertices == std::vector<glm::vec3>{{5, 1, 0}, {6, 0, 0}});
    CHECK(file.parts[1].mesh.triangles == std::vector<glm::uvec3>{{0, 1, 0}});
    const auto says = [&](const std::string& part) {
        return std::ranges::any_of(file.not_shown, [&](const std::string& s) { return s.find(part) == 0; });
    };
    CHECK(says("has animations"));
    CHECK(says("uses unsupported extensions: KHR_lights_punctual (missing: lights"));
}

TEST_CASE("a skin is bent by its joints") {
    Corner corner;
    // The first corner follows joint 0, the second joint 1, and the third each by half.
    corner.add("VEC4", 5121, 3, corner.bytes.add(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}));
    corner.add("VEC4", 5126, 3, corner.bytes.add(std::vector<float>{2, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}));
    // The inverse of the second joint's placement moves by one to the left.
    corner.add("MAT4", 5126, 2, corner.bytes.add(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                                                    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1}));
    const auto file = [&](const std::string& skin) {
        return corner.file(
            R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
            {"translation": [0, 0, 3], "children": [2]}, {"translation": [1, 0, 0], "rotation": [0.70710678, 0, 0, 0.70710678]}],
            "skins": [)" +
            skin + "], " + meshes(R"("attributes": {"POSITION": 0, "NORMAL": 1, "JOINTS_0": 5, "WEIGHTS_0": 6})"));
    };
    const gltf::Part part = read(file(R"({"joints": [1, 2], "inverseBindMatrices": 7})")).parts.at(0);
    // Computed by hand: the first joint lifts by 3; the second rotates y to z about the line through (1, 0, 0), and
    // also lifts.
    CHECK(is_near(part.mesh.vertices[0], {0, 0, 3}));
    CHECK(is_near(part.mesh.vertices[1], {1, 0, 3}));
    CHECK(is_near(part.mesh.vertices[2], {0, 0.5f, 3.5f}));
    CHECK(is_near(part.normals.values[0], {0, 0, 1}));
    CHECK(is_near(part.normals.values[1], {0, -1, 0}));
    CHECK(said(file(R"({"joints": [1]})")) == "accessors[5] refers to a joint that its skin does not have");
    CHECK(said(file(R"({"joints": [1, 3]})")) == "skins[0] has a joint that is not in the scene");
    CHECK(said(file(R"({"joints": [1, 2], "inverseBindMatrices": 0})")) == "accessors[0] has no matrices");
}

TEST_CASE("instances of a node stand where their list says") {
    Corner corner;
    corner.add("VEC3", 5126, 2, corner.bytes.add(std::vector<float>{1, 0, 0, 0, 2, 0}));
    corner.add("VEC3", 5126, 2, corner.bytes.add(std::vector<float>{1, 1, 1, 3, 3, 3}));
    const auto file = [&](const std::string& attributes) {
        return corner.file(R"("extensionsRequired": ["EXT_mesh_gpu_instancing"], "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "translation": [0, 0, 7], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {)" +
                           attributes + R"(}}}}], )" + meshes(all_attributes));
    };
    const gltf::Part part = read(file(R"("TRANSLATION": 5, "SCALE": 6)")).parts.at(0);
    REQUIRE(part.mesh.vertices.size() == 6);
    CHECK(is_near(part.mesh.vertices[1], {2, 0, 7}));
    CHECK(is_near(part.mesh.vertices[4], {3, 2, 7}));
    CHECK(said(file(R"("TRANSLATION": 5, "SCALE": 1)")) ==
          "accessors[1] has a different number of rows than the other attributes of the instances");
    CHECK(said(file(R"("ROTATION": 5)")) == "accessors[5] has rows of the wrong length for instances");
    CHECK(said(file(R"("TRANSLATION": 5)"), {.primitives = 1}) == "it has too many meshes");
}

TEST_CASE("what is mirrored keeps its outer side: normals, the order of corners, and tangents") {
    Corner corner;
    corner.add("VEC4", 5126, 3, corner.bytes.add(std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}));
    const std::size_t view = corner.add_view(png(std::vector<unsigned char>(12, 255)));
    corner.add("VEC4", 5121, 3, corner.bytes.add(std::vector<std::uint8_t>(12, 0)));
    corner.add("VEC4", 5126, 3, corner.bytes.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    const auto part = [&](const std::string& node, const std::string& more) {
        return read(corner.file(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, )" + node +
                                R"(}, {"scale": [-1, 1, 1]}], "skins": [{"joints": [1]}], )" +
                                meshes(R"("attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "TANGENT": 5)" +
                                       more + R"(}, "material": 0)") +
                                R"(, "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}],
                                "images": [{"bufferView": )" +
                                std::to_string(view) + "}]"))
            .parts.at(0);
    };
    const auto face = [](const gltf::Part& p) {
        const glm::uvec3& t = p.mesh.triangles.at(0);
        const auto& v = p.mesh.vertices;
        return glm::normalize(glm::cross(v[t.y] - v[t.x], v[t.z] - v[t.x]));
    };
    for (const bool is_skinned : {false, true}) {
        CAPTURE(is_skinned);
        const gltf::Part mirrored = part(is_skinned ? "\"skin\": 0" : "\"scale\": [-1, 1, 1]",
                                         is_skinned ? R"(, "JOINTS_0": 7, "WEIGHTS_0": 8)" : "");
        CHECK(is_near(mirrored.mesh.vertices[1], {-1, 0, 0}));
        CHECK(is_near(face(mirrored), {0, 0, 1}));
        CHECK(is_near(mirrored.normals.values[0], {0, 0, 1}));
        // The tangent now points to the left, and up in the image stays up: cross(n, t) · w.
        CHECK(is_near(glm::vec3(mirrored.tangents.values[0]), {-1, 0, 0}));
        CHECK(mirrored.tangents.values[0].w == -1);
    }
    const gltf::Part turned = part("\"scale\": [-1, -1, 1]", "");
    CHECK(is_near(face(turned), {0, 0, 1}));
    CHECK(is_near(turned.normals.values[0], {0, 0, 1}));
    CHECK(turned.tangents.values[0].w == 1);
}

TEST_CASE("integers that stand for fractions are those of their type") {
    Corner corner;
    corner.add(
        "VEC3", 5120, 3,
        corner.bytes.add(std::vector<std::int8_t>{-128, -127, 127, 0, 1, 0, 0, 0, 64, 0, 0, 0}, R"(, "byteStride": 4)"),
        R"(, "normalized": true)");
    const gltf::Part part = read(corner.file(one_node + meshes(R"("attributes": {"POSITION": 5})"))).parts.at(0);
    CHECK(is_near(part.mesh.vertices[0], {-1, -1, 1}));
    CHECK(is_near(part.mesh.vertices[1], {1 / 127.0f, 0, 0}));
}

TEST_CASE("of another material all is one part, and what has no colours is white") {
    const std::string file = Corner().file(
        one_node + R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}, {)" + all_attributes + "}]}]");
    CHECK(read(file).parts.size() == 2);
    const gltf::GltfFile all = gltf::read_gltf(file, gltf::ReadMaterials::none);
    REQUIRE(all.parts.size() == 1);
    REQUIRE(all.parts[0].colors.values.size() == 6);
    CHECK(is_near(all.parts[0].colors.values[0], {1, 1, 1}));
    CHECK(is_near(all.parts[0].colors.values[3], {1, 0, 0}));
}

TEST_CASE("a scene has the parts of a file as meshes, turned upright and placed") {
    const phasetree::support::TemporaryDirectory folder;
    phasetree::support::write_text(
        folder / "a.glb",
        Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes + R"(, "material": 1}, {)" +
                      all_attributes + R"(, "material": 0}]}], "materials": [
                        {"name": "brass"}, {"name": "pine", "pbrMetallicRoughness": {"metallicFactor": 0}}])"));
    const auto scene = [&](const std::string& more) {
        return scene_of(
            R"("a": {"diffuse": {"color": [1, 1, 1]}})", R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})",
            std::string(white_environment) + R"(, "meshes": [{"floor": {"material": {"diffuse": {"color": [1, 1, 1]}}}},
                            {"gltf": {"file": ")" +
                (folder / "a.glb").string() + "\"" + more + "}}]");
    };
    const Scene placed = scene(R"(, "scale": 2, "rotate_z": 90, "translate": [0, 0, 3])");
    REQUIRE(placed.meshes.size() == 3);
    CHECK(placed.meshes[1].name == "gltf brass");
    CHECK(placed.meshes[2].name == "gltf pine");
    // glTF's y is up, so (0, 1, 0) is (0, 0, 1), then (0, 0, 2) and (0, 0, 5); (1, 0, 0) is rotated to y.
    CHECK(is_near(placed.meshes[1].vertices.at(2), {0, 0, 5}));
    CHECK(is_near(placed.meshes[1].vertices.at(1), {0, 2, 3}));
    const Scene painted = scene(R"(, "material": {"diffuse": {"color": {"vertex_color": {}}}})");
    CHECK(std::holds_alternative<Diffuse>(painted.meshes[1].material));
    CHECK(painted.not_shown.empty());
}

}  // namespace test_gltf_meshes
