// Meshes from .glb files: where they are, what they are made of, and what is no such file.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/glm.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "gltf/read_glb.hpp"
#include "paths.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "shading/bsdf/coated_diffuse.hpp"
#include "tracer/written_glb.hpp"

namespace test_glb_meshes {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::glb;
using phasetree::tests::GlbBytes;

namespace {

// A triangle, (0,0,0) (1,0,0) (0,1,0), with normals that lean, coordinates and colours: accessors 0 to 3, indices 4.
struct Corner {
    GlbBytes bytes;
    std::string views, accessors;

    Corner() {
        add("VEC3", 5126, 3, bytes.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
        add("VEC3", 5126, 3, bytes.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0.6f, 0, 0.8f}));
        add("VEC2", 5126, 3, bytes.add(std::vector<float>{0, 0, 1, 0, 0, 1}));
        add("VEC3", 5126, 3, bytes.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
        add("SCALAR", 5123, 3, bytes.add(std::vector<std::uint16_t>{0, 1, 2}));
    }
    void add(const std::string& type, int number, std::size_t rows, const std::string& view,
             const std::string& more = "") {
        const std::string comma = views.empty() ? "" : ", ";
        accessors += comma + "{\"bufferView\": " + std::to_string(count_) +
                     ", \"componentType\": " + std::to_string(number) + ", \"count\": " + std::to_string(rows) +
                     ", \"type\": \"" + type + "\"" + more + "}";
        views += comma + view;
        ++count_;
    }
    // Takes bytes that no accessor reads, such as an image; returns the number of the view.
    std::size_t add_view(const std::string& content) {
        add("SCALAR", 5121, 0, bytes.add(content));
        return count_ - 1;
    }
    std::string file(const std::string& rest) const {
        return glb("\"accessors\": [" + accessors + "], \"bufferViews\": [" + views + "], " + rest, bytes.bytes());
    }

  private:
    std::size_t count_ = 0;
};

const std::string all_attributes =
    R"("attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3}, "indices": 4)";
const std::string one_node = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], )";

std::string meshes(const std::string& primitive) {
    return R"("meshes": [{"primitives": [{)" + primitive + "}]}]";
}

gltf::GlbFile read(const std::string& content, const gltf::Limits& limits = {}) {
    return gltf::read_glb(content, gltf::ReadMaterials::all, limits);
}

// The only part of a file with a triangle of this material.
gltf::Part part_of(const std::string& material, const Corner& corner = {}, const std::string& more = "") {
    gltf::GlbFile file = read(corner.file(one_node + meshes(all_attributes + R"(, "material": 0)") +
                                          R"(, "materials": [)" + material + "]" + more));
    REQUIRE(file.parts.size() == 1);
    return std::move(file.parts[0]);
}

std::string said(const std::string& content, const gltf::Limits& limits = {}) {
    try {
        (void)read(content, limits);
    } catch (const gltf::GltfError& e) {
        return e.what();
    }
    return "read";
}

bool is_near(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-5f;
}

std::string bytes_of(const std::string& path) {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
}

// A PNG of 2×2 pixels, from the upper left one to the lower right one.
std::string png(const std::vector<unsigned char>& pixels) {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = (folder / "a.png").string();
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out);
    REQUIRE(out->open(path, OIIO::ImageSpec(2, 2, 3, OIIO::TypeDesc::UINT8)));
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
    out->close();
    return bytes_of(path);
}

}  // namespace

TEST_CASE("nodes place meshes by matrices and by parts, and those of others in them") {
    const std::string placed = R"("scenes": [{"nodes": [0]}], "nodes": [
        {"translation": [10, 0, 0], "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 1, 1], "children": [1, 2]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 5, 1]},
        {"mesh": 0}], )";
    const gltf::Part part = read(Corner().file(placed + meshes(all_attributes))).parts.at(0);
    REQUIRE(part.mesh.triangles.size() == 2);
    REQUIRE(part.mesh.vertices.size() == 6);
    // By hand: the matrix turns y to z and moves up by 5; the parent stretches x, makes x to y and y to −x, and moves.
    CHECK(is_near(part.mesh.vertices[0], {10, 0, 5}));
    CHECK(is_near(part.mesh.vertices[1], {10, 2, 5}));
    CHECK(is_near(part.mesh.vertices[2], {10, 0, 6}));
    CHECK(is_near(part.mesh.vertices[4], {10, 2, 0}));
    CHECK(is_near(part.mesh.vertices[5], {9, 0, 0}));
    // A normal that leans along x leans half as much along the stretched x.
    CHECK(is_near(part.normals.values[5], glm::normalize(glm::vec3(0, 0.3f, 0.8f))));
    CHECK(is_near(part.colors.values[4], {0, 1, 0}));
    CHECK(said(Corner().file(R"("nodes": [{"mesh": 0}], )" + meshes(all_attributes))) ==
          "it has no triangles in its scene");
}

TEST_CASE("triangles of all modes and all types of indices") {
    const auto square = [](const std::string& how, int type, const std::string& view) {
        Corner c;
        GlbBytes& bytes = c.bytes;
        // Rows of five floats, of which the first three are the place.
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
    const gltf::GlbFile lines = read(Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes +
                                                   "}, {" + all_attributes + R"(, "mode": 1}]}])"));
    CHECK(lines.parts.at(0).mesh.triangles.size() == 1);
    CHECK(lines.not_shown.back() == "has points or lines, which are not shown");
}

TEST_CASE("glTF's materials as ours") {
    const gltf::Part plain = part_of(R"({"name": "wood", "pbrMetallicRoughness":
        {"baseColorFactor": [0.5, 0.25, 0.75, 1], "metallicFactor": 0, "roughnessFactor": 0.5}})");
    CHECK(plain.name == "wood");
    const Coated& coated = std::get<Coated>(plain.material);
    CHECK(std::get<float>(coated.roughness) == 0.25f);
    CHECK(coated.ior == 1.5f);
    // What is seen of the base under the coat is the file's colour times that of the vertices.
    TexturePoint place({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.color = {0.5f, 1, 1}});
    const glm::vec3 base = color_at(coated.color, place);
    const float inside = CoatingAlbedo(1.5f, 0.0f).at(0.0f).internal().x;
    const glm::vec3 seen = base * (1 - inside) / (1.0f - base * inside);
    CHECK(is_near(seen, {0.25f, 0.25f, 0.75f}));
    CHECK_FALSE(is_near(1.01f * seen, {0.25f, 0.25f, 0.75f}));

    const gltf::Part gold = part_of(R"({"pbrMetallicRoughness":
        {"baseColorFactor": [0.9, 0.6, 0.2, 1], "roughnessFactor": 0.3}})");
    CHECK(gold.name == "material 0");
    const Conductor& metal = std::get<Conductor>(gold.material);
    CHECK(std::get<float>(metal.roughness) == doctest::Approx(0.09f));
    // The vertices are red, green and blue, a third of white in the mean.
    const glm::vec3 reflected = fresnel_conductor(1, metal.eta, metal.k);
    CHECK(is_near(reflected, {0.3f, 0.2f, 0.2f / 3}));
    CHECK_FALSE(is_near(1.01f * reflected, {0.3f, 0.2f, 0.2f / 3}));
    // glTF's own material is a metal, white and rough.
    CHECK(
        std::holds_alternative<Conductor>(read(Corner().file(one_node + meshes(all_attributes))).parts.at(0).material));

    const gltf::Part lamp = part_of(R"({"emissiveFactor": [1, 0.5, 0.25], "pbrMetallicRoughness":
        {"baseColorFactor": [0, 0, 0, 1]}, "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})");
    const Glowing& glowing = std::get<Glowing>(lamp.material);
    CHECK(is_near(glowing.radiance * color_at(glowing.light, place), {8, 4, 2}));
    CHECK(std::get<Coated>(part_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_ior": {"ior": 1.33}}})")
                               .material)
              .ior == 1.33f);
}

TEST_CASE("what is clear is left out, and what is lost is said") {
    const std::string glass =
        R"({"name": "pane", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})";
    const std::string faint = R"({"name": "faint", "alphaMode": "BLEND", "pbrMetallicRoughness":
        {"baseColorFactor": [1, 1, 1, 0.2]}})";
    const std::string leaf = R"({"name": "leaf", "alphaMode": "MASK", "normalTexture": {"index": 0}})";
    const gltf::GlbFile file = read(Corner().file(
        one_node + R"("meshes": [{"primitives": [{)" + all_attributes + R"(, "material": 0}, {)" + all_attributes +
        R"(, "material": 1}, {)" + all_attributes + R"(, "material": 2}, {)" + all_attributes + R"(, "material": 0}]}],
        "materials": [)" +
        glass + ", " + faint + ", " + leaf + "]"));
    REQUIRE(file.parts.size() == 1);
    CHECK(file.parts[0].name == "leaf");
    // The leaf is also a metal, as what says nothing of it is, with the colours of vertices.
    CHECK(file.not_shown.size() == 5);
    CHECK(file.not_shown.at(3) == "\"leaf\" has a normal map, which is ignored");
    CHECK(file.not_shown.at(0).find("\"pane\" is clear, and is left out") == 0);
    CHECK(file.not_shown.at(1).find("\"faint\" is clear") == 0);
    CHECK(file.not_shown.at(2).find("\"leaf\" is partly transparent") == 0);
    // Names are for people: one line, and short.
    const gltf::Part odd = part_of("{\"name\": \"a\\u001b[2Jb\\u009bc" + std::string(99, 'x') + "\"}");
    CHECK(odd.name.find('\x1b') == std::string::npos);
    CHECK(odd.name.find("\xc2\x9b") == std::string::npos);
    CHECK(odd.name.size() <= 60);
}

TEST_CASE("images lie as glTF lays them, also moved, turned and stretched") {
    Corner corner;
    // Red, green; blue, grey. glTF's (0, 0) is the upper left corner.
    const std::size_t view = corner.add_view(png({255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128}));
    const std::string rest = R"(, "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) +
                             R"(, "mimeType": "image/png"}])";
    const auto color_of = [&](const std::string& transform, const glm::vec2& barycentric) {
        const gltf::Part part =
            part_of(R"({"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0)" + transform + "}}", corner, rest);
        const auto at = [&](int i) { return part.texture.at(part.mesh.triangles, 0, i); };
        const glm::vec2 uv =
            (1 - barycentric.x - barycentric.y) * at(0) + barycentric.x * at(1) + barycentric.y * at(2);
        return color_at(std::get<Glowing>(part.material).light,
                        TexturePoint({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = uv}));
    };
    // The triangle's corners have the coordinates (0, 0), (1, 0) and (0, 1) of glTF.
    CHECK(is_near(color_of("", {0.25f, 0.25f}), {1, 0, 0}));
    CHECK(is_near(color_of("", {0.75f, 0.25f}), {0, 1, 0}));
    CHECK(is_near(color_of("", {0.25f, 0.75f}), {0, 0, 1}));
    const auto transform = [](const std::string& how) {
        return R"(, "extensions": {"KHR_texture_transform": {)" + how + "}}";
    };
    CHECK(is_near(color_of(transform(R"("offset": [0.5, 0])"), {0.25f, 0.25f}), {0, 1, 0}));
    CHECK(is_near(color_of(transform(R"("offset": [0, 0.5])"), {0.25f, 0.25f}), {0, 0, 1}));
    CHECK(is_near(color_of(transform(R"("scale": [3, 1])"), {0.25f, 0.25f}), {0, 1, 0}));
    // A quarter turn, counter-clockwise with v downwards: (u, v) becomes (v, −u).
    CHECK(is_near(color_of(transform(R"("rotation": 1.57079633)"), {0.75f, 0.25f}), {1, 0, 0}));
    CHECK(is_near(color_of(transform(R"("rotation": 1.57079633)"), {0.25f, 0.25f}), {0, 0, 1}));
    // The scale comes before the turn, and the offset after it: (0.25, 0.25) to (0.75, 0.25) to (0.25, −0.75).
    CHECK(is_near(color_of(transform(R"("scale": [3, 1], "rotation": 1.57079633, "offset": [0, 0.5])"), {0.25f, 0.25f}),
                  {0, 0, 1}));
}

TEST_CASE("an image of roughness and metal: green is the roughness, blue how much is metal") {
    Corner corner;
    const std::size_t view = corner.add_view(png({0, 128, 255, 0, 255, 255, 0, 0, 255, 0, 64, 255}));
    const std::string rest =
        R"(, "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) + "}]";
    const auto material = [&](const std::string& more) {
        return part_of(R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0})" + more + "}}", corner,
                       rest)
            .material;
    };
    const Conductor metal = std::get<Conductor>(material(""));
    const auto roughness = [&](const glm::vec2& uv) {
        return number_at(metal.roughness, TexturePoint({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = uv}));
    };
    // The file's numbers are not encoded as colours are. Ours have v upwards.
    CHECK(roughness({0.25f, 0.75f}) == doctest::Approx(std::pow(128 / 255.0, 2)).epsilon(1e-3));
    CHECK_FALSE(1.01 * roughness({0.25f, 0.75f}) == doctest::Approx(std::pow(128 / 255.0, 2)).epsilon(1e-3));
    CHECK(roughness({0.75f, 0.25f}) == doctest::Approx(std::pow(64 / 255.0, 2)).epsilon(1e-3));
    CHECK(least_of(metal.roughness) == 0);
    CHECK(greatest_of(metal.roughness) == 1);
    CHECK(std::holds_alternative<Coated>(material(R"(, "metallicFactor": 0.4)")));
    CHECK(std::holds_alternative<Conductor>(material(R"(, "metallicFactor": 0.6)")));
}

TEST_CASE("images of colours beside alpha are as they are stored") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = (folder / "a.png").string();
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out);
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    REQUIRE(out->open(path, spec));
    const unsigned char pixels[] = {200, 100, 50, 128, 200, 100, 50, 0};
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels));
    out->close();
    const glm::vec3 stored = glm::vec3(200, 100, 50) / 255.0f;
    const auto is_stored = [&](const TextureImage& image) {
        return glm::length(image.at({0.25f, 0.5f}) - stored) < 1e-4f &&
               glm::length(image.at({0.75f, 0.5f}) - stored) < 1e-4f;
    };
    CHECK(is_stored(*load_texture_image(path, ImageMeaning::numbers)));
    CHECK(is_stored(texture_image_in_memory(bytes_of(path), "a", ImageMeaning::numbers)));
}

TEST_CASE("what shines in a few places is dark, what shines in most is a lamp; another material replaces all") {
    Corner corner;
    const std::size_t few = corner.add_view(png({255, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    const std::size_t most = corner.add_view(png({255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0}));
    const auto emitting = [&](std::size_t view) {
        return corner.file(
            one_node + meshes(all_attributes + R"(, "material": 0)") +
            R"(, "materials": [{"name": "panel", "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0},
                               "pbrMetallicRoughness": {"metallicFactor": 0}}], "textures": [{"source": 0}],
                               "images": [{"bufferView": )" +
            std::to_string(view) + "}]");
    };
    const gltf::GlbFile dark = read(emitting(few));
    CHECK(std::holds_alternative<Coated>(dark.parts.at(0).material));
    CHECK(dark.not_shown == std::vector<std::string>{"\"panel\" shines in some places; here it is dark"});
    CHECK(std::holds_alternative<Glowing>(read(emitting(most)).parts.at(0).material));
    // Clear parts, and images that cannot be read, do not matter then.
    const std::string odd =
        Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes + R"(, "material": 0}, {)" +
                      all_attributes + R"(, "material": 1}, {)" + all_attributes + R"(, "mode": 0}]}], "materials": [
            {"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{}])");
    CHECK(said(odd).find("has no image that this program reads") != std::string::npos);
    const gltf::GlbFile all = gltf::read_glb(odd, gltf::ReadMaterials::none);
    REQUIRE(all.parts.size() == 1);
    CHECK(all.parts[0].mesh.triangles.size() == 2);
    CHECK(all.not_shown == std::vector<std::string>{"has points or lines, which are not shown"});
    CHECK(said(Corner().file(
                   one_node + meshes(all_attributes + R"(, "material": 0)") +
                   R"(, "materials": [{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}])"))
              .find("all of it is clear") == 0);
}

TEST_CASE("parts have names of their own, vertices that no triangle has are not taken, and skins are said") {
    Corner corner;
    corner.add("SCALAR", 5121, 3, corner.bytes.add(std::vector<std::uint8_t>{2, 1, 2}));
    const gltf::GlbFile file = read(corner.file(
        R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "skin": 0, "translation": [5, 0, 0]}], "animations": [{}],
           "meshes": [{"weights": [1], "primitives": [{)" +
        all_attributes + R"(, "material": 0}, {"attributes": {"POSITION": 0}, "indices": 5, "material": 1}]}],
           "materials": [{"name": "wood"}, {"name": "wood"}], "extensions": {"KHR_lights_punctual": {}})"));
    REQUIRE(file.parts.size() == 2);
    CHECK(file.parts[0].name == "wood");
    CHECK(file.parts[1].name == "wood 2");
    CHECK(file.parts[1].mesh.vertices == std::vector<glm::vec3>{{0, 1, 0}, {1, 0, 0}});
    CHECK(file.parts[1].mesh.triangles == std::vector<glm::uvec3>{{0, 1, 0}});
    // A skin is where its joints are, which no node of its mesh moves.
    CHECK(is_near(file.parts[0].mesh.vertices[0], {0, 0, 0}));
    const auto says = [&](const std::string& part) {
        return std::ranges::any_of(file.not_shown, [&](const std::string& s) { return s.find(part) == 0; });
    };
    for (const char* const sentence : {"has lights", "has animations", "has meshes with skins", "has morph targets"})
        CHECK(says(sentence));
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
                            {"glb": {"file": ")" +
                (folder / "a.glb").string() + "\"" + more + "}}]");
    };
    const Scene placed = scene(R"(, "scale": 2, "rotate_z": 90, "translate": [0, 0, 3])");
    REQUIRE(placed.meshes.size() == 3);
    CHECK(placed.meshes[1].name == "glb brass");
    CHECK(placed.meshes[2].name == "glb pine");
    // glTF's y is up, so (0, 1, 0) is (0, 0, 1), then (0, 0, 2) and (0, 0, 5); (1, 0, 0) is turned to y.
    CHECK(is_near(placed.meshes[1].vertices.at(2), {0, 0, 5}));
    CHECK(is_near(placed.meshes[1].vertices.at(1), {0, 2, 3}));
    const Scene painted = scene(R"(, "material": {"diffuse": {"color": {"vertex_color": {}}}})");
    CHECK(std::holds_alternative<Diffuse>(painted.meshes[1].material));
    CHECK(painted.not_shown.empty());
}

TEST_CASE("what is no .glb file, or is more than is read, is said") {
    const std::string good = Corner().file(one_node + meshes(all_attributes));
    CHECK(said(good) == "read");
    CHECK(said("") == "it is no .glb file: it does not begin with \"glTF\"");
    CHECK(said("{\"asset\": {}}").find("it is a .gltf file") == 0);
    CHECK(said(glb("\"x\": 1", "", 1)) == "it is not of version 2 of glTF");
    const auto file = [](const std::string& rest) { return Corner().file(rest); };
    CHECK(said(file(R"("extensionsRequired": ["KHR_draco_mesh_compression"])"))
              .find("it requires KHR_draco_mesh_compression,") == 0);
    CHECK(said(file(R"("extensionsRequired": ["KHR_texture_transform", "KHR_materials_transmission"])")) ==
          "it has no triangles in its scene");
    CHECK(said(file(R"("scenes": [{"nodes": [7]}])")) == "0 of \"scenes\" refers to 7 of \"nodes\", which has 0");
    CHECK(said(file(R"("scenes": [{"nodes": "all"}])")) == "0 of \"scenes\" should have a list \"nodes\"");
    CHECK(said(file(R"("scenes": [{"nodes": [0]}], "nodes": [{"scale": [1, 2]}])")) ==
          "0 of \"nodes\" should have 3 numbers in \"scale\"");
    CHECK(said(file(one_node + meshes(R"("attributes": {"NORMAL": 1})"))) ==
          "\"primitives\" 0 of 0 of \"meshes\" has no positions");
    CHECK(said(file(one_node + meshes(R"("attributes": {"POSITION": 2})"))) ==
          "2 of \"accessors\" has positions that are not of three numbers");
    CHECK(said(file(one_node + meshes(R"("attributes": {"POSITION": 0}, "indices": 0)"))) ==
          "0 of \"accessors\" has indices that are not whole numbers from 0");
    const auto accessor = [](const std::string& more) {
        Corner c;
        c.add("VEC3", 5126, 3, c.bytes.add(std::vector<float>(9, 0.5f)), more);
        return c.file(one_node + meshes(R"("attributes": {"POSITION": 5})"));
    };
    CHECK(said(accessor("")) == "read");
    CHECK(said(accessor(R"(, "byteOffset": 4)")) == "5 of \"accessors\" is beyond the end of its bytes");
    CHECK(said(accessor(R"(, "sparse": {})")) == "5 of \"accessors\" is sparse, which this program does not read");
    Corner huge;
    huge.add("VEC3", 5126, 3, huge.bytes.add(std::vector<float>(9, 1e30f)));
    CHECK(said(huge.file(one_node + meshes(R"("attributes": {"POSITION": 5})"))).find("beyond 10") !=
          std::string::npos);
    Corner dark;
    dark.add("VEC3", 5126, 3, dark.bytes.add(std::vector<float>(9, std::nanf(""))));
    CHECK(said(dark.file(one_node + meshes(R"("attributes": {"POSITION": 0, "COLOR_0": 5})")))
              .find("5 of \"accessors\" has something that is no number") == 0);
    CHECK(
        said(
            glb(R"("bufferViews": [{"buffer": 1, "byteLength": 4}], "accessors": [{"bufferView": 0, "componentType": 5126,
        "count": 1, "type": "VEC3"}], )" +
                    one_node + meshes(R"("attributes": {"POSITION": 0})"),
                "    "))
            .find("0 of \"bufferViews\" is in another file") == 0);
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
    // Nodes in circles, and one that is in two places.
    CHECK(said(Corner().file(R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}])")) ==
          "0 of \"nodes\" is at two places of the tree of nodes");
    // One mesh at two places counts twice.
    const std::string twice = Corner().file(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0}], )" +
                                            meshes(all_attributes));
    CHECK(said(twice, {.triangles = 2}) == "read");
    CHECK(said(twice, {.triangles = 1}) == "there are more triangles than 0 million");
    Corner doubled;
    doubled.add("SCALAR", 5121, 6, doubled.bytes.add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 0}));
    const std::string both = doubled.file(one_node + meshes(R"("attributes": {"POSITION": 0}, "indices": 5)"));
    CHECK(said(both, {.triangles = 2}) == "read");
    // Too many materials, pixels or brackets.
    const std::string two =
        Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes + R"(, "material": 0}, {)" +
                      all_attributes + R"(, "material": 1}]}], "materials": [{}, {}])");
    CHECK(said(two, {.primitives = 2}) == "read");
    CHECK(said(two, {.primitives = 1}) == "there are more primitives than 1");
    CHECK(said(two, {.materials = 2}) == "read");
    CHECK(said(two, {.materials = 1}) == "there are more materials than 1");
    CHECK(said(good, {.pixels = 4}) == "read");
    CHECK(said(good, {.pixels = 3}) == "its images have more than 0 million pixels in all");
    CHECK(said(glb("\"x\": " + std::string(10'000'000, '['), "")) == "its document is deeper than 64 brackets");
    // Many elements that nobody asks for, and many that name one node, take no time.
    std::string many;
    for (int i = 0; i < 1'000'000; ++i) many += i > 0 ? ",{}" : "{}";
    CHECK(said(Corner().file(one_node + meshes(all_attributes) + R"(, "extras": [)" + many + "]")) == "read");
    std::string same = "1";
    for (int i = 0; i < 1'000'000; ++i) same += ",1";
    CHECK(said(Corner().file(R"("scenes": [{"nodes": [)" + same + R"(]}], "nodes": [{}, {}])")) ==
          "1 of \"nodes\" is at two places of the tree of nodes");
    const std::string deep = "\"x\": " + std::string(60, '[') + std::string(60, ']');
    CHECK(said(Corner().file(one_node + meshes(all_attributes) + ", " + deep)) == "read");
    CHECK(said(both, {.triangles = 1}) == "there are more triangles than 0 million");
}

}  // namespace test_glb_meshes
