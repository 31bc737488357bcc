// The alpha of vertex colours in glTF files, which makes holes if the material uses alpha.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tracer/gltf/gltf_scene_mesh.hpp"

namespace test_gltf_vertex_alpha {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("a scene's mesh has holes where the mean of its vertices' alpha is below the cutoff") {
    Corner corner;
    corner.add("VEC4", 5126, 3, corner.bytes.add(std::vector<float>{1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 0}));
    const auto mesh = [&](const std::string& mode) {
        return scene_mesh(
            corner.file(one_node + meshes(R"("attributes": {"POSITION": 0, "COLOR_0": 5}, "material": 0)") +
                        R"(, "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}, )" + mode + "}]"));
    };
    const Mesh blended = mesh(R"("alphaMode": "BLEND")"), cut = mesh(R"("alphaMode": "MASK", "alphaCutoff": 0.6)");
    REQUIRE(blended.opacity);
    REQUIRE(cut.opacity);
    for (const auto& [u, v] : {std::pair(0.0f, 0.0f), {0.5f, 0.0f}, {0.0f, 0.3f}, {0.2f, 0.6f}, {0.0f, 1.0f}}) {
        const float alpha = 1 - 0.5f * u - v;
        CAPTURE(alpha);
        CHECK(blended.opacity->at(place_on(blended, 0, u, v)) == doctest::Approx(alpha));
        CHECK(cut.opacity->at(place_on(cut, 0, u, v)) == (alpha >= 0.6f ? 1 : 0));
    }
    CHECK_FALSE(mesh(R"("alphaMode": "OPAQUE")").opacity);
}

TEST_CASE("alpha is that of the factor, times that of the image, times that of the vertices") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = (folder / "a.png").string();
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out);
    REQUIRE(out->open(path, OIIO::ImageSpec(2, 1, 4, OIIO::TypeDesc::UINT8)));
    const unsigned char pixels[] = {255, 255, 255, 51, 255, 255, 255, 204};
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels));
    out->close();
    Corner corner;
    corner.add("VEC4", 5121, 3,
               corner.bytes.add(std::vector<std::uint8_t>{255, 255, 255, 255, 0, 0, 0, 102, 0, 0, 0, 0}),
               R"(, "normalized": true)");
    const std::size_t view = corner.add_view(bytes_of(path));
    const auto part = [&](const std::string& mode, const std::string& colors) {
        return read(corner.file(
                        one_node +
                        meshes(R"("attributes": {"POSITION": 0, "TEXCOORD_0": 2)" + colors + R"(}, "material": 0)") +
                        R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                     "baseColorFactor": [1, 1, 1, 0.5]}, )" +
                        mode + R"(}], "textures": [{"source": 0}], "images": [{"bufferView": )" + std::to_string(view) +
                        "}]"))
            .parts.at(0);
    };
    const std::string colors = R"(, "COLOR_0": 5)";
    const gltf::Part blended = part(R"("alphaMode": "BLEND")", colors);
    CHECK(blended.alphas.values == std::vector<float>{1, 0.4f, 0});
    REQUIRE(blended.opacity);
    const auto at = [](const Opacity& o, float u, float alpha) {
        return o.at(TexturePoint({0, 0, 0}, {0, 0, 1}, MeshCoordinates{.uv = {u, 0.5f}, .alpha = alpha}));
    };
    CHECK(at(*blended.opacity, 0.25f, 1) == doctest::Approx(0.1).epsilon(1e-4));
    CHECK(at(*blended.opacity, 0.75f, 0.5f) == doctest::Approx(0.2).epsilon(1e-4));
    const gltf::Part cut = part(R"("alphaMode": "MASK", "alphaCutoff": 0.3)", colors);
    CHECK(at(cut.opacity.value(), 0.75f, 0.8f) == 1);
    CHECK(at(cut.opacity.value(), 0.75f, 0.7f) == 0);
    CHECK(at(cut.opacity.value(), 0.25f, 1) == 0);
    // Colours without alpha, or with alpha 1 everywhere, cost nothing.
    CHECK(part(R"("alphaMode": "BLEND")", R"(, "COLOR_0": 3)").alphas.empty());
    CHECK_FALSE(part(R"("alphaMode": "BLEND")", R"(, "COLOR_0": 3)").opacity->by_vertices);
    CHECK_FALSE(part(R"("alphaMode": "MASK", "alphaCutoff": 0.05)", R"(, "COLOR_0": 3)").opacity);
}

}  // namespace test_gltf_vertex_alpha
