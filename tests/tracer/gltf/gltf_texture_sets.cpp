// Materials of glTF files whose images use several sets of texture coordinates, or several transforms of one set.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tracer/gltf/gltf_scene_mesh.hpp"

namespace test_gltf_texture_sets {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

using Floats = std::vector<float>;

constexpr std::array<float, 8> whole{0, 1, 1, 1, 1, 0, 0, 0}, turned{1, 1, 1, 0, 0, 0, 0, 1};

Floats stretched(const std::array<float, 8>& uv, float x, float y) {
    Floats all(uv.begin(), uv.end());
    for (std::size_t i = 0; i < 8; i += 2) all[i] = x * all[i] + 0.25f, all[i + 1] = y * all[i + 1];
    return all;
}

// A square with a colour image and an image of roughness and metalness, each with a set and a transform.
struct Square {
    std::string color = R"("texCoord": 0)", metal = R"("texCoord": 0)";
    std::array<Floats, 3> sets{};
    std::string more = "";  // of the material

    std::string file() const {
        Corner corner;
        corner.add("VEC3", 5126, 4, corner.bytes.add(Floats{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}));
        corner.add("SCALAR", 5121, 6, corner.bytes.add(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}));
        std::string attributes = R"("POSITION": 5)";
        for (std::size_t i = 0; i < sets.size(); ++i)
            if (!sets[i].empty()) {
                corner.add("VEC2", 5126, 4, corner.bytes.add(sets[i]));
                attributes += ", \"TEXCOORD_" + std::to_string(i) + "\": " + std::to_string(corner.last());
            }
        const std::size_t colors = corner.add_view(png({255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128}));
        const std::size_t metals = corner.add_view(png({0, 64, 0, 0, 64, 255, 0, 255, 0, 0, 128, 0}));
        return corner.file(one_node + meshes("\"attributes\": {" + attributes + R"(}, "indices": 6, "material": 0)") +
                           R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, )" + color +
                           R"(}, "metallicRoughnessTexture": {"index": 1, )" + metal + "}}" + more +
                           R"(}], "textures": [{"source": 0}, {"source": 1}], "images": [{"bufferView": )" +
                           std::to_string(colors) + R"(}, {"bufferView": )" + std::to_string(metals) + "}]");
    }
};

std::string transformed(const std::string& by) {
    return R"("extensions": {"KHR_texture_transform": {)" + by + "}}";
}

// The look of a point of a triangle: the colour under the coat, and its metalness.
glm::vec4 look(const Mesh& mesh, std::size_t triangle, const glm::vec2& at) {
    const TexturePoint place = place_on(mesh, triangle, at.x, at.y);
    const Mix& mix = std::get<Mix>(mesh.material);
    return {color_at(std::get<Coated>(mix.of->first).color, place), number_at(mix.amount, place)};
}

// The largest difference between their looks at some points.
float difference(const Square& a, const Square& b) {
    const Mesh one = scene_mesh(a.file()), other = scene_mesh(b.file());
    float most = 0;
    for (std::size_t t = 0; t < 2; ++t)
        for (const glm::vec2& at : {glm::vec2(0.1f, 0.2f), glm::vec2(0.6f, 0.1f), glm::vec2(0.3f, 0.65f)})
            most = std::max(most, glm::length(look(one, t, at) - look(other, t, at)));
    return most;
}

}  // namespace

TEST_CASE("images of one material lie each by its own set of coordinates") {
    const Floats first(whole.begin(), whole.end()), second(turned.begin(), turned.end());
    const Square same{.sets = {first, {}, {}}};
    // A set that both images use may have any number.
    CHECK(difference({.color = R"("texCoord": 1)", .metal = R"("texCoord": 1)", .sets = {second, first, {}}}, same) ==
          0);
    // Two equal sets count as one; two that differ do not.
    CHECK(difference({.metal = R"("texCoord": 1)", .sets = {first, first, {}}}, same) == 0);
    const Square apart{.metal = R"("texCoord": 1)", .sets = {first, second, {}}};
    CHECK(difference(apart, same) > 0.1f);
    // The same with other numbers, including that of the extension, which replaces the number of the reference.
    CHECK(difference({.color = R"("texCoord": 2)", .metal = R"("texCoord": 0)", .sets = {second, {}, first}}, apart) ==
          0);
    CHECK(difference({.metal = R"("texCoord": 0, )" + transformed(R"("texCoord": 2)"), .sets = {first, {}, second}},
                     apart) == 0);
}

TEST_CASE("a transform of one image is that of the coordinates themselves") {
    const Floats first(whole.begin(), whole.end());
    const std::string by = transformed(R"("offset": [0.25, 0], "scale": [0.5, 2])");
    constexpr float rounding = 1e-5f;
    // The metalness image is stretched: once with the first set, and once with a second set.
    const Square metal{.metal = R"("texCoord": 1)", .sets = {first, stretched(whole, 0.5f, 2), {}}};
    CHECK(difference({.metal = by, .sets = {first, {}, {}}}, metal) < rounding);
    CHECK(difference({.metal = R"("texCoord": 1, )" + by, .sets = {first, first, {}}}, metal) < rounding);
    CHECK(difference({.sets = {first, {}, {}}}, metal) > 0.1f);
    // The first image is stretched; the other is not.
    const Square color{.color = R"("texCoord": 1)", .sets = {first, stretched(whole, 0.5f, 2), {}}};
    CHECK(difference({.color = by, .sets = {first, {}, {}}}, color) < rounding);
    CHECK(difference(metal, color) > 0.1f);
    // A transform to a single pixel has no inverse, and the second image needs none.
    const std::string pixel = transformed(R"("offset": [0.75, 0.25], "scale": [0, 0])");
    const Floats one_pixel{0.75f, 0.25f, 0.75f, 0.25f, 0.75f, 0.25f, 0.75f, 0.25f};
    CHECK(difference({.color = pixel, .sets = {first, {}, {}}},
                     {.color = R"("texCoord": 1)", .sets = {first, one_pixel, {}}}) == 0);
}

TEST_CASE("a map of normals decides about the mesh's own coordinates, by which its tangents are made") {
    const Floats first(whole.begin(), whole.end()), second(turned.begin(), turned.end());
    const Square square{.sets = {first, second, {}}, .more = R"(, "normalTexture": {"index": 0, "texCoord": 1})"};
    const gltf::Part part = read(square.file()).parts.at(0);
    // The upper edge of an image is at 1 here, and at 0 in the file.
    CHECK(part.texture.values.at(1) == glm::vec2(1, 1));
    CHECK(part.second_texture.values.at(1) == glm::vec2(1, 0));
}

TEST_CASE("a third set is not read, which is said") {
    const Floats first(whole.begin(), whole.end());
    const Square square{.metal = R"("texCoord": 1)",
                        .sets = {first, first, first},
                        .more = R"(, "normalTexture": {"index": 0, "texCoord": 2})"};
    CHECK(read(square.file()).not_shown ==
          std::vector<std::string>{
              "\"material 0\" uses more than two sets of texture coordinates; one image is mapped by another set"});
}

}  // namespace test_gltf_texture_sets
