// Morph targets of glTF files, with the weights of the node or the mesh.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tracer/gltf/gltf_corner.hpp"

namespace test_gltf_morphs {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

using Floats = std::vector<float>;

// Two targets: one moves the second vertex and tilts normals; the other, stored in bytes, lifts all vertices by one.
Corner with_targets() {
    Corner corner;
    corner.add("VEC3", 5126, 3, corner.bytes.add(Floats{0, 0, 0, 2, 0, 4, 0, 0, 0}));
    corner.add("VEC3", 5126, 3, corner.bytes.add(Floats{1, 0, 0, 1, 0, 0, 0, 0, 0}));
    corner.add(
        "VEC3", 5120, 3,
        corner.bytes.add(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, R"(, "byteStride": 4)"),
        R"(, "normalized": true)");
    return corner;
}

gltf::Part part_by(const std::string& node, const std::string& mesh) {
    return read(with_targets().file(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" + node +
                                    R"(}], "meshes": [{"primitives": [{)" + all_attributes +
                                    R"(, "targets": [{"POSITION": 5, "NORMAL": 6}, {"POSITION": 7}]}])" + mesh + "}]"))
        .parts.at(0);
}

}  // namespace

TEST_CASE("morphed vertices are those of a mesh that was moved by hand") {
    Corner moved;
    moved.add("VEC3", 5126, 3, moved.bytes.add(Floats{0, 0, 0.25f, 2, 0, 2.25f, 0, 1, 0.25f}));
    moved.add("VEC3", 5126, 3, moved.bytes.add(Floats{0.5f, 0, 1, 0.5f, 0, 1, 0.6f, 0, 0.8f}));
    const gltf::Part expected =
        read(moved.file(
                 R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [1, 2, 1]}], )" +
                 meshes(R"("attributes": {"POSITION": 5, "NORMAL": 6, "TEXCOORD_0": 2, "COLOR_0": 3}, "indices": 4)")))
            .parts.at(0);
    const std::string scale = R"(, "scale": [1, 2, 1])";
    check_same(part_by(scale, R"(, "weights": [0.5, 0.25])"), expected);
    // The node's weights take precedence over those of the mesh.
    check_same(part_by(scale + R"(, "weights": [0.5, 0.25])", R"(, "weights": [1, 1])"), expected);
}

TEST_CASE("targets without weights move nothing, and are ignored") {
    const gltf::Part still = read(Corner().file(one_node + meshes(all_attributes))).parts.at(0);
    check_same(part_by("", ""), still);
    check_same(part_by(R"(, "weights": [0, 0])", R"(, "weights": [1, 1])"), still);
    const auto said_of = [](const std::string& weights, const std::string& target, const gltf::Limits& limits = {}) {
        return said(with_targets().file(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "weights": )" + weights +
                                        "}], " + meshes(all_attributes + R"(, "targets": [)" + target + "]")),
                    limits);
    };
    CHECK(said_of("[0]", R"({"POSITION": 99})") == "read");
    CHECK(said_of("[1, 1]", R"({})") == "read");
    CHECK(said_of("[1]", R"({"POSITION": 99})").find("meshes[0].primitives[0].targets[0] refers to accessors[99]") ==
          0);
    CHECK(said_of("[1]", R"({"POSITION": 2})") == "accessors[2] has too few numbers per row");
    CHECK(said_of("[1, 1]", R"({"POSITION": 5}, {"POSITION": 5})", {.moves = 8}) == "read");
    CHECK(said_of("[1, 1]", R"({"POSITION": 5}, {"POSITION": 5})", {.moves = 7}) ==
          "its morph targets move more than 0 million vertices");
}

TEST_CASE("a target turns tangents, and skins bend what is morphed") {
    Corner corner = with_targets();
    corner.add("VEC4", 5126, 3, corner.bytes.add(Floats{1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}));
    corner.add("VEC3", 5126, 3, corner.bytes.add(Floats{-1, 1, 0, 0, 0, 0, 0, 0, 0}));
    corner.add("VEC4", 5121, 3, corner.bytes.add(std::vector<std::uint8_t>(12, 0)));
    corner.add("VEC4", 5126, 3, corner.bytes.add(Floats{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    const std::size_t view = corner.add_view(png(std::vector<unsigned char>(12, 255)));
    const gltf::Part part =
        read(corner.file(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "skin": 0, "weights": [1]},
                            {"scale": [3, 1, 1]}], "skins": [{"joints": [1]}], )" +
                         meshes(R"("attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "TANGENT": 8,
                                   "JOINTS_0": 10, "WEIGHTS_0": 11}, "targets": [{"POSITION": 5, "TANGENT": 9}],
                                   "material": 0)") +
                         R"(, "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}],
                            "images": [{"bufferView": )" +
                         std::to_string(view) + "}]"))
            .parts.at(0);
    CHECK(part.mesh.vertices.at(1) == glm::vec3(9, 0, 4));
    REQUIRE(part.tangents.values.size() == 3);
    CHECK(is_near(glm::vec3(part.tangents.values[0]), {0, 1, 0}));
    CHECK(is_near(glm::vec3(part.tangents.values[1]), {1, 0, 0}));
    CHECK(part.tangents.values[0].w == -1);
}

}  // namespace test_gltf_morphs
