// The materials and images of glTF files, converted to ours.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shading/bsdf/coated_diffuse.hpp"
#include "tracer/gltf/gltf_corner.hpp"
#include "tracer/support/paths.hpp"

namespace test_gltf_materials {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("glTF's materials as ours") {
    const gltf::Part plain = part_of(R"({"name": "wood", "pbrMetallicRoughness":
        {"baseColorFactor": [0.5, 0.25, 0.75, 1], "metallicFactor": 0, "roughnessFactor": 0.5}})");
    CHECK(plain.name == "wood");
    const Coated& coated = std::get<Coated>(plain.material);
    CHECK(std::get<float>(coated.roughness) == 0.25f);
    CHECK(coated.ior == 1.5f);
    // The visible colour of the base under the coat is the file's colour times that of the vertices.
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
    CHECK(std::get<float>(metal.roughness) == doctest::Approx(0.3125 * 0.3125));  // rounded to 32nds
    REQUIRE(metal.reflectance);
    CHECK(is_near(color_at(*metal.reflectance, place), {0.45f, 0.6f, 0.2f}));
    CHECK_FALSE(is_near(1.01f * color_at(*metal.reflectance, place), {0.45f, 0.6f, 0.2f}));
    // Without vertex colours and images, it is the same everywhere.
    const gltf::GltfFile silver =
        read(Corner().file(one_node + meshes(R"("attributes": {"POSITION": 0}, "material": 0)") +
                           R"(, "materials": [{"pbrMetallicRoughness":
        {"baseColorFactor": [0.9, 0.6, 0.2, 1]}}])"));
    const Conductor& one_color = std::get<Conductor>(silver.parts.at(0).material);
    CHECK_FALSE(one_color.reflectance);
    const glm::vec3 reflected = fresnel_conductor(1, one_color.eta, one_color.k);
    CHECK(is_near(reflected, {0.9f, 0.6f, 0.2f}));
    CHECK_FALSE(is_near(1.01f * reflected, {0.9f, 0.6f, 0.2f}));
    // A half metal is a mixture.
    const gltf::Part half = part_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0.3}})");
    const Mix& mix = std::get<Mix>(half.material);
    CHECK(std::get<float>(mix.amount) == 0.3f);
    CHECK(std::holds_alternative<Coated>(mix.of->first));
    CHECK(std::holds_alternative<Conductor>(mix.of->second));
    // glTF's default material is a metal, white and rough.
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
    Corner corner;
    const std::size_t view = corner.add_view(png({0, 0, 0, 255, 255, 255, 0, 0, 0, 0, 0, 0}));
    const auto file = [&](const std::vector<std::string>& materials) {
        std::string primitives, list;
        for (std::size_t i = 0; i < materials.size(); ++i) {
            primitives += (i == 0 ? "{" : ", {") + all_attributes + ", \"material\": " + std::to_string(i) + "}";
            list += (i == 0 ? "" : ", ") + materials[i];
        }
        return read(corner.file(one_node + "\"meshes\": [{\"primitives\": [" + primitives + "]}], \"materials\": [" +
                                list + R"(], "textures": [{"source": 0}], "images": [{"bufferView": )" +
                                std::to_string(view) + "}]"));
    };
    const std::string plain = R"("pbrMetallicRoughness": {"metallicFactor": 0})";
    const auto clear = [&](const std::string& name, const std::string& how) {
        return "{\"name\": \"" + name + "\", " + plain +
               R"(, "extensions": {"KHR_materials_volume": {"thicknessFactor": 0.1}, "KHR_materials_transmission": {)" +
               how + "}}}";
    };
    // A quarter of the image is white.
    const gltf::GltfFile some =
        file({clear("pane", R"("transmissionFactor": 1)"), clear("half", R"("transmissionFactor": 0.5)"),
              clear("faint", R"("transmissionFactor": 0.4)"),
              clear("print", R"("transmissionFactor": 1, "transmissionTexture": {"index": 0})"),
              clear("wall", R"("transmissionFactor": 0)")});
    REQUIRE(some.parts.size() == 3);
    CHECK(some.parts[0].name == "faint");
    CHECK(some.parts[1].name == "print");
    CHECK(some.not_shown.size() == 5);
    CHECK(some.not_shown.at(0).find("\"pane\" is clear and therefore ignored") == 0);
    CHECK(some.not_shown.at(1).find("\"half\" is clear") == 0);
    CHECK(some.not_shown.at(2) == "\"faint\" is partly transmissive; it is rendered as opaque");
    CHECK(some.not_shown.at(3) == "\"print\" is partly transmissive; it is rendered as opaque");
    CHECK(some.not_shown.at(4).find("KHR_materials_volume") != std::string::npos);

    const gltf::GltfFile odd =
        file({R"({"name": "varnish", )" + plain + R"(, "extensions": {"KHR_materials_subsurface": {},
        "KHR_materials_\u001b[2J": {}}})",
              R"({"name": "dial", "emissiveFactor": [0.001, 0, 0]})"});
    CHECK(odd.not_shown.at(0) == "\"dial\" is faintly emissive; it is rendered without emission");
    CHECK(odd.not_shown.at(1) ==
          "uses unsupported extensions: KHR_materials_subsurface (missing: subsurface scattering) and 1 more");
    CHECK(std::holds_alternative<Conductor>(odd.parts.at(1).material));
    // Names are for people: one line, and short.
    const gltf::Part escape = part_of("{\"name\": \"a\\u001b[2Jb\\u009bc" + std::string(99, 'x') + "\"}");
    CHECK(escape.name.find('\x1b') == std::string::npos);
    CHECK(escape.name.find("\xc2\x9b") == std::string::npos);
    CHECK(escape.name.size() <= 60);
}

TEST_CASE("what glows lies by the coordinates of its own images, and is dark where its image cannot be read") {
    Corner corner;
    const std::size_t view = corner.add_view(png(std::vector<unsigned char>(12, 255)));
    const std::string rest =
        R"(, "textures": [{"source": 0}, {}], "images": [{"bufferView": )" + std::to_string(view) + "}]";
    const auto material = [&](const std::string& emissive) {
        return R"({"name": "screen", "emissiveFactor": [1, 1, 1], "emissiveTexture": )" + emissive +
               R"(, "normalTexture": {"index": 0, "texCoord": 1}, "pbrMetallicRoughness": {"metallicFactor": 0}})";
    };
    const auto file = [&](const std::string& emissive) {
        return read(corner.file(one_node + meshes(all_attributes + R"(, "material": 0)") + R"(, "materials": [)" +
                                material(emissive) + "]" + rest));
    };
    const gltf::GltfFile glowing = file(R"({"index": 0})");
    CHECK(std::holds_alternative<Glowing>(glowing.parts.at(0).material));
    CHECK(glowing.not_shown ==
          std::vector<std::string>{"\"screen\" is emissive and has a normal map, which is ignored"});
    // Set 0 exists; set 1, which the map uses, does not.
    CHECK(glm::length(glowing.parts[0].texture.values.at(1) - glm::vec2(1, 1)) < 1e-6f);
    const gltf::GltfFile dark = file(R"({"index": 1})");
    CHECK(std::holds_alternative<Coated>(dark.parts.at(0).material));
    CHECK(dark.not_shown.front().find("has an image in an unsupported format") != std::string::npos);
}

TEST_CASE("alpha makes holes where the file says that it counts") {
    Corner corner;
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = (folder / "a.png").string();
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out);
    REQUIRE(out->open(path, OIIO::ImageSpec(2, 1, 4, OIIO::TypeDesc::UINT8)));
    const unsigned char pixels[] = {255, 255, 255, 51, 255, 255, 255, 204};
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels));
    out->close();
    const std::size_t view = corner.add_view(bytes_of(path));
    const std::string rest =
        R"(, "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) + "}]";
    const auto opacity = [&](const std::string& mode, const std::string& color) {
        return part_of("{" + mode + R"("pbrMetallicRoughness": {"metallicFactor": 0, )" + color + "}}", corner, rest)
            .opacity;
    };
    const std::string image = R"("baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.5])";
    const auto at = [&](const Opacity& o, float u) {
        return o.at(TexturePoint({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = {u, 0.5f}}));
    };
    CHECK_FALSE(opacity("", image));
    CHECK_FALSE(opacity(R"("alphaMode": "OPAQUE", )", image));
    CHECK_FALSE(opacity(R"("alphaMode": "BLEND", )", R"("baseColorFactor": [1, 1, 1, 1])"));
    CHECK_FALSE(opacity(R"("alphaMode": "MASK", )", R"("baseColorFactor": [1, 1, 1, 0.6])"));
    const auto blended = opacity(R"("alphaMode": "BLEND", )", image);
    REQUIRE(blended);
    CHECK(at(*blended, 0.25f) == doctest::Approx(0.1).epsilon(1e-4));
    CHECK(at(*blended, 0.75f) == doctest::Approx(0.4).epsilon(1e-4));
    CHECK(at(opacity(R"("alphaMode": "BLEND", )", R"("baseColorFactor": [1, 1, 1, 0.25])").value(), 0) == 0.25f);
    const auto cut = opacity(R"("alphaMode": "MASK", "alphaCutoff": 0.3, )", image);
    REQUIRE(cut);
    CHECK(at(*cut, 0.25f) == 0);
    CHECK(at(*cut, 0.75f) == 1);
    // If no alpha reaches the cutoff, nothing is left.
    CHECK(at(opacity(R"("alphaMode": "MASK", "alphaCutoff": 2, )", image).value(), 0.75f) == 0);
    // The other image has no alpha.
    Corner without;
    const std::size_t plain = without.add_view(png(std::vector<unsigned char>(12, 255)));
    CHECK_FALSE(part_of(R"({"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})", without,
                        R"(, "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(plain) + "}]")
                    .opacity);
}

TEST_CASE("maps of normals are read with their scale, and tangents where they belong to them") {
    Corner corner;
    corner.add("VEC4", 5126, 3, corner.bytes.add(std::vector<float>{3, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}));
    const std::size_t view = corner.add_view(png(std::vector<unsigned char>(12, 255)));
    const auto part = [&](const std::string& material, const std::string& attributes) {
        return read(corner.file(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [2, 1, 1],
            "rotation": [0, 0, 0.70710678, 0.70710678]}], )" +
                                meshes(R"("attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2)" + attributes +
                                       R"(}, "material": 0)") +
                                R"(, "materials": [)" + material +
                                R"(], "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) +
                                "}]"))
            .parts.at(0);
    };
    const auto mapped = [](const std::string& more) {
        return R"({"normalTexture": {"index": 0)" + more + R"(}, "pbrMetallicRoughness": {"metallicFactor": 0}})";
    };
    const std::string tangent = R"(, "TANGENT": 5)";
    const gltf::Part given = part(mapped(R"(, "scale": 0.5)"), tangent);
    REQUIRE(normal_map_of(given.material));
    CHECK(normal_map_of(given.material)->strength == 0.5f);
    CHECK_FALSE(normal_map_of(given.material)->green_down);
    REQUIRE(given.tangents.values.size() == 3);
    CHECK(is_near(glm::vec3(given.tangents.values[0]), {0, 1, 0}));
    CHECK(given.tangents.values[0].w == -1);
    CHECK(normal_map_of(part(mapped(R"(, "scale": -2)"), "").material)->strength == -2);
    CHECK(part(mapped(""), "").tangents.empty());
    CHECK(part(mapped(R"(, "extensions": {"KHR_texture_transform": {"rotation": 1}})"), tangent).tangents.empty());
    CHECK(part(R"({"pbrMetallicRoughness": {"metallicFactor": 0}})", tangent).tangents.empty());
    CHECK(normal_map_of(part(R"({"normalTexture": {"index": 0}})", "").material));  // a metal
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
    // The scale is applied before the rotation, and the offset after it: (0.25, 0.25) to (0.75, 0.25) to (0.25, −0.75).
    CHECK(is_near(color_of(transform(R"("scale": [3, 1], "rotation": 1.57079633, "offset": [0, 0.5])"), {0.25f, 0.25f}),
                  {0, 0, 1}));
}

TEST_CASE("an image of roughness and metal: green is the roughness, blue how much is metal") {
    Corner corner;
    const std::size_t view = corner.add_view(png({0, 128, 255, 0, 255, 0, 0, 0, 255, 0, 64, 255}));
    const std::string rest =
        R"(, "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) + "}]";
    const auto material = [&](const std::string& more) {
        return part_of(R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0})" + more + "}}", corner,
                       rest)
            .material;
    };
    const Mix mix = std::get<Mix>(material(""));
    const Conductor metal = std::get<Conductor>(mix.of->second);
    const auto amount = [&](const Mix& of, const glm::vec2& uv) {
        return number_at(of.amount, TexturePoint({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = uv}));
    };
    CHECK(amount(mix, {0.25f, 0.75f}) == 1);
    CHECK(amount(mix, {0.75f, 0.75f}) == 0);
    CHECK(amount(std::get<Mix>(material(R"(, "metallicFactor": 0.4)")), {0.25f, 0.25f}) == doctest::Approx(0.4));
    const auto roughness = [&](const glm::vec2& uv) {
        return number_at(metal.roughness, TexturePoint({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = uv}));
    };
    // The file's numbers are linear, unlike colours. In ours, v points up.
    CHECK(roughness({0.25f, 0.75f}) == doctest::Approx(std::pow(128 / 255.0, 2)).epsilon(1e-3));
    CHECK_FALSE(1.01 * roughness({0.25f, 0.75f}) == doctest::Approx(std::pow(128 / 255.0, 2)).epsilon(1e-3));
    CHECK(roughness({0.75f, 0.25f}) == doctest::Approx(std::pow(64 / 255.0, 2)).epsilon(1e-3));
    CHECK(least_of(metal.roughness) == 0);
    CHECK(greatest_of(metal.roughness) == 1);
    CHECK(std::holds_alternative<Coated>(material(R"(, "metallicFactor": 0)")));
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
    const gltf::GltfFile dark = read(emitting(few));
    CHECK(std::holds_alternative<Coated>(dark.parts.at(0).material));
    CHECK(dark.not_shown ==
          std::vector<std::string>{"\"panel\" is emissive in some places; it is rendered without emission"});
    CHECK(std::holds_alternative<Glowing>(read(emitting(most)).parts.at(0).material));
    // Clear parts, and images that cannot be read, do not matter then.
    const std::string odd =
        Corner().file(one_node + R"("meshes": [{"primitives": [{)" + all_attributes + R"(, "material": 0}, {)" +
                      all_attributes + R"(, "material": 1}, {)" + all_attributes + R"(, "mode": 0}]}], "materials": [
            {"extensions": {"KHR_materials_volume": {}, "KHR_materials_transmission": {"transmissionFactor": 1}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{}])");
    CHECK(read(odd).not_shown.at(1) ==
          "\"material 1\" has an image in an unsupported format, which is ignored; use PNG or JPEG");
    const gltf::GltfFile all = gltf::read_gltf(odd, gltf::ReadMaterials::none);
    REQUIRE(all.parts.size() == 1);
    CHECK(all.parts[0].mesh.triangles.size() == 2);
    CHECK(all.not_shown == std::vector<std::string>{"has points or lines, which are ignored"});
    CHECK(
        said(
            Corner().file(
                one_node + meshes(all_attributes + R"(, "material": 0)") +
                R"(, "materials": [{"extensions": {"KHR_materials_volume": {}, "KHR_materials_transmission": {"transmissionFactor": 1}}}])"))
            .find("all its materials are clear") == 0);
}

}  // namespace test_gltf_materials
