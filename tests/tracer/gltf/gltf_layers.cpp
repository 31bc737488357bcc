// glTF's materials with coats, sheen, specular factors, anisotropy and films, converted to our layers.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gltf/thin_material.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/read_parts.hpp"
#include "tracer/gltf/gltf_corner.hpp"

namespace test_gltf_layers {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string plastic = R"("pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.75, 1], "metallicFactor": 0,
    "roughnessFactor": 0.5})";

gltf::Part part_with(const std::string& extensions, const std::string& rest = plastic, const std::string& more = "") {
    Corner corner;
    // Red is 0 or 1, green 0.2, blue 1; alpha 1 or 0.
    const std::size_t view = corner.add_view(png({0, 51, 255, 255, 51, 255, 0, 51, 255, 255, 51, 255}));
    return part_of("{" + rest + R"(, "extensions": {)" + extensions + "}}", corner,
                   R"(, "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) + "}]" + more);
}

Principled layers_of(const std::string& extensions, const std::string& rest = plastic) {
    return std::get<Principled>(part_with(extensions, rest).material);
}

float constant(const Number& number) {
    return std::get<float>(number);
}

}  // namespace

TEST_CASE("materials without layers, and factors of 0, do not become principled") {
    CHECK(std::holds_alternative<Coated>(part_of("{" + plastic + "}").material));
    for (const char* const nothing :
         {R"("KHR_materials_clearcoat": {})", R"("KHR_materials_sheen": {"sheenColorFactor": [0, 0, 0]})",
          R"("KHR_materials_specular": {"specularFactor": 1})",
          R"("KHR_materials_anisotropy": {"anisotropyStrength": 0})",
          R"("KHR_materials_iridescence": {"iridescenceIor": 1.5})"}) {
        CAPTURE(nothing);
        CHECK(std::holds_alternative<Coated>(part_with(nothing).material));
    }
    // A metal has no specular factors.
    CHECK(std::holds_alternative<Conductor>(
        part_with(R"("KHR_materials_specular": {"specularFactor": 0.5})", R"("name": "metal")").material));
}

TEST_CASE("a clear coat keeps the colour, roughness and index of its base") {
    const Principled layers = layers_of(R"("KHR_materials_clearcoat": {"clearcoatFactor": 0.75,
        "clearcoatRoughnessFactor": 0.5}, "KHR_materials_ior": {"ior": 1.4})");
    CHECK(is_near(color_at(layers.color, glm::vec3(0)), {0.5f, 0.25f, 0.75f}));
    CHECK(constant(layers.roughness) == 0.5f);
    CHECK(constant(layers.metalness) == 0.0f);
    CHECK(layers.ior == 1.4f);
    CHECK(constant(layers.coat_weight) == 0.75f);
    CHECK(constant(layers.coat_roughness) == 0.5f);
    CHECK(layers.coat_ior == 1.5f);
    CHECK(constant(layers.coat_darkening) == 0.0f);
    CHECK(constant(layers.fuzz_weight) == 0.0f);
    CHECK_FALSE(layers.film);
    CHECK_FALSE(layers.emission);
    // Images: the weight is red, the roughness green.
    const Principled laid = layers_of(R"("KHR_materials_clearcoat": {"clearcoatFactor": 0.5,
        "clearcoatTexture": {"index": 0}, "clearcoatRoughnessFactor": 1, "clearcoatRoughnessTexture": {"index": 0}})");
    const TexturePoint place({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = {0.75f, 0.75f}});
    CHECK(number_at(laid.coat_weight, place) == doctest::Approx(0.5));
    CHECK(number_at(laid.coat_roughness, place) == doctest::Approx(0.2).epsilon(1e-3));
    CHECK(least_of(laid.coat_weight) == 0.0f);
    CHECK(greatest_of(laid.coat_weight) == 0.5f);
    CHECK(greatest_of(laid.coat_roughness) == 0.25f);  // in quarters
}

TEST_CASE("sheen is fuzz of its largest component; films and specular factors are ours") {
    const Principled cloth = layers_of(R"("KHR_materials_sheen": {"sheenColorFactor": [0.2, 0.4, 0.8],
        "sheenRoughnessFactor": 0.3})");
    CHECK(constant(cloth.fuzz_weight) == 0.8f);
    CHECK(is_near(color_at(cloth.fuzz_color, glm::vec3(0)), {0.25f, 0.5f, 1.0f}));
    CHECK(constant(cloth.fuzz_roughness) == 0.3f);

    const Principled film = layers_of(R"("KHR_materials_iridescence": {"iridescenceFactor": 0.5, "iridescenceIor": 1.6,
        "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 300,
        "iridescenceThicknessTexture": {"index": 0}})");
    CHECK(constant(film.film_weight) == 0.5f);
    REQUIRE(film.film);
    CHECK(film.film->ior == 1.6f);
    CHECK(number_at(film.film->thickness, {{0, 0, 0}, {0, 0, 1}, MeshCoordinates{}}) ==
          doctest::Approx(220).epsilon(1e-3));

    const std::string specular =
        R"("KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0]})";
    const Principled dull = layers_of(specular);
    CHECK(constant(dull.specular_weight) == 0.5f);
    CHECK(is_near(color_at(dull.specular_color, glm::vec3(0)), {1, 0.5f, 0}));
    // They do not apply to the metal of a mixture.
    const Material mixed =
        part_with(specular, R"("pbrMetallicRoughness": {"metallicFactor": 0.3, "roughnessFactor": 0.5})").material;
    const Mix& mix = std::get<Mix>(mixed);
    CHECK(constant(mix.amount) == 0.3f);
    CHECK(constant(std::get<Principled>(mix.of->first).specular_weight) == 0.5f);
    CHECK(constant(std::get<Principled>(mix.of->first).metalness) == 0.0f);
    CHECK(constant(std::get<Principled>(mix.of->second).specular_weight) == 1.0f);
    CHECK(constant(std::get<Principled>(mix.of->second).metalness) == 1.0f);
}

TEST_CASE("anisotropy is a grain across the direction of the stretch, by the mesh's tangents") {
    const std::string brushed = R"("KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 0})";
    const gltf::Part part = part_with(brushed, R"("pbrMetallicRoughness": {"roughnessFactor": 0.5})");
    const Principled& layers = std::get<Principled>(part.material);
    const float alpha = 0.25f, stretched = alpha + 0.75f * 0.25f;
    CHECK(constant(layers.roughness) == doctest::Approx(std::sqrt(stretched)));
    REQUIRE(layers.grain);
    CHECK(layers.grain->aspect == doctest::Approx(alpha / stretched));
    CHECK(needs_tangents(part.material));
    CHECK(part.texture.values.size() == 3);
    // The strokes run along the bitangent where the direction is the tangent.
    MeshCoordinates coordinates;
    coordinates.tangent = {1, 0, 0}, coordinates.bitangent = {0, 1, 0};
    CHECK(layers.grain->direction_at({{0, 0, 0}, {0, 0, 1}, coordinates}) == glm::vec3(0, 1, 0));
    CHECK(layers.grain->direction_at(glm::vec3(0)) == glm::vec3(0));
    // A mesh in a scene receives tangents if the file has none.
    const phasetree::support::TemporaryDirectory folder;
    phasetree::support::write_text(folder / "a.glb",
                                   Corner().file(one_node + meshes(all_attributes + R"(, "material": 0)") +
                                                 R"(, "materials": [{"extensions": {)" + brushed + "}}]"));
    const auto document =
        phasetree::Document::from_text(R"([{"gltf": {"file": ")" + (folder / "a.glb").string() + "\"}}]");
    const MeshGroup group = read_meshes(document, document.root());
    REQUIRE(group.meshes.size() == 1);
    CHECK(group.meshes[0].tangents.values.size() == 3);
}

TEST_CASE("a layered material may emit light and have normals") {
    const std::string coat = R"("KHR_materials_clearcoat": {"clearcoatFactor": 1},
        "KHR_materials_emissive_strength": {"emissiveStrength": 8})";
    const std::string lamp = plastic + R"(, "emissiveFactor": [1, 0.5, 0.25], "normalTexture": {"index": 0})";
    const gltf::Part part = part_with(coat, lamp);
    const Principled& layers = std::get<Principled>(part.material);
    CHECK(layers.perturbation);
    REQUIRE(layers.emission);
    CHECK(is_near(layers.emission->radiance * color_at(layers.emission->light, glm::vec3(0)), {8, 4, 2}));
    CHECK(glows(part.material));
}

TEST_CASE("warnings name what layers lose") {
    const auto said_of = [](const std::string& extensions, const std::string& rest = plastic) {
        Corner corner;
        const std::size_t view = corner.add_view(png(std::vector<unsigned char>(12, 255)));
        return read(corner.file(one_node + meshes(all_attributes + R"(, "material": 0)") +
                                R"(, "materials": [{"name": "a", )" + rest + R"(, "extensions": {)" + extensions +
                                R"(}}], "textures": [{"source": 0}],
                                "images": [{"bufferView": )" +
                                std::to_string(view) + "}]"))
            .not_shown;
    };
    using Sentences = std::vector<std::string>;
    CHECK(said_of(R"("KHR_materials_clearcoat": {"clearcoatFactor": 1})").empty());
    CHECK(said_of(R"("KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}})") ==
          Sentences{"\"a\" has different normals on its clear coat, which are ignored; it has those of the base"});
    CHECK(said_of(R"("KHR_materials_specular": {"specularColorFactor": [2, 1, 1]})") ==
          Sentences{"\"a\" has a specular colour above 1, which is clamped"});
    CHECK(said_of(R"("KHR_materials_anisotropy": {"anisotropyStrength": 1, "anisotropyTexture": {"index": 0}})") ==
          Sentences{"\"a\" has an image of its anisotropy, which is ignored"});
}

TEST_CASE("what transmits light without a volume is a pane, and what transmits it diffusely is a sheet") {
    const TexturePoint place({0, 0, 0});
    const ThinGlass pane = std::get<ThinGlass>(
        part_with(R"("KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.4})")
            .material);
    CHECK(pane.ior == 1.4f);
    CHECK(is_near(color_at(pane.color, place), {0.5f, 0.25f, 0.75f}));
    CHECK_FALSE(is_near(1.01f * color_at(pane.color, place), {0.5f, 0.25f, 0.75f}));
    CHECK(constant(pane.roughness) == 0.25f);
    // Without a metallic factor it is not metal.
    CHECK(std::holds_alternative<ThinGlass>(
        part_with(R"("KHR_materials_transmission": {"transmissionFactor": 1})", R"("name": "window")").material));
    CHECK(std::holds_alternative<ThinGlass>(
        part_with(
            R"("KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 0})")
            .material));
    const Mix half = std::get<Mix>(part_with(R"("KHR_materials_transmission": {"transmissionFactor": 0.4})").material);
    CHECK(constant(half.amount) == 0.4f);
    CHECK(std::holds_alternative<Coated>(half.of->first));
    CHECK(std::holds_alternative<ThinGlass>(half.of->second));
    // The texture's red channel is 0 or 1.
    const Mix print = std::get<Mix>(
        part_with(R"("KHR_materials_transmission": {"transmissionFactor": 0.8, "transmissionTexture": {"index": 0}})")
            .material);
    CHECK(least_of(print.amount) == 0.0f);
    CHECK(greatest_of(print.amount) == doctest::Approx(0.8f));
    // Metal is opaque, whatever the factor.
    const std::string metal = R"("pbrMetallicRoughness": {"metallicFactor": 1})";
    CHECK(std::holds_alternative<Conductor>(
        part_with(R"("KHR_materials_transmission": {"transmissionFactor": 1})", metal).material));

    const ThinDiffuse leaf = std::get<ThinDiffuse>(
        part_with(
            R"("KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.25, "diffuseTransmissionColorFactor": [0.4, 0.8, 0.2]})")
            .material);
    CHECK(is_near(color_at(leaf.color, place), {0.375f, 0.1875f, 0.5625f}));
    CHECK(is_near(color_at(leaf.transmission, place), {0.1f, 0.2f, 0.05f}));
    CHECK_FALSE(is_near(1.01f * color_at(leaf.transmission, place), {0.1f, 0.2f, 0.05f}));
    // The factor's image is in the alpha channel; this one has none, which counts as 1.
    const ThinDiffuse whole = std::get<ThinDiffuse>(
        part_with(
            R"("KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 1, "diffuseTransmissionTexture": {"index": 0}})")
            .material);
    CHECK(color_at(whole.color, place) == glm::vec3(0));
    // Where an image says how much is transmitted, it mixes an opaque material and a sheet that only transmits.
    const Mix spotted = std::get<Mix>(gltf::with_diffuse_transmission(
        Diffuse(), TintedMeshImage(), ConstantTexture{glm::vec3(0.5f)}, MeshImageNumber{.range = {0, 1}}));
    CHECK(std::holds_alternative<Diffuse>(spotted.of->first));
    CHECK(std::holds_alternative<ThinDiffuse>(spotted.of->second));
}

}  // namespace test_gltf_layers
