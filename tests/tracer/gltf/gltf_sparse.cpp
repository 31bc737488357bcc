// Sparse accessors of glTF files.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tracer/gltf/gltf_corner.hpp"

namespace test_gltf_sparse {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// An accessor in which some rows are replaced. `base` is the number of its view; without it, the other rows are zero.
struct Sparse {
    std::string type;
    int component = 5126;
    std::size_t rows = 3;
    std::string more{};
    std::optional<std::size_t> base{};
};

template <class Index, class Number>
std::size_t add_sparse(Corner& corner, const Sparse& of, const std::vector<Index>& indices,
                       const std::vector<Number>& values) {
    const int type = sizeof(Index) == 1 ? 5121 : sizeof(Index) == 2 ? 5123 : 5125;
    corner.add("SCALAR", 5121, 0, corner.bytes.add(indices));
    const std::string of_indices = std::to_string(corner.last());
    corner.add("SCALAR", 5121, 0, corner.bytes.add(values));
    const std::string of_values = std::to_string(corner.last());
    const std::string base = of.base ? "\"bufferView\": " + std::to_string(*of.base) + ", " : "";
    return corner.add_accessor("{" + base + R"("type": ")" + of.type + R"(", "componentType": )" +
                               std::to_string(of.component) + ", \"count\": " + std::to_string(of.rows) + of.more +
                               ", \"sparse\": {\"count\": " + std::to_string(indices.size()) +
                               ", \"indices\": {\"bufferView\": " + of_indices + ", \"componentType\": " +
                               std::to_string(type) + "}, \"values\": {\"bufferView\": " + of_values + "}}}");
}

std::string skinned(const std::string& attributes, const std::string& more = "") {
    return R"("scenes": [{"nodes": [0, 1, 2]}], "nodes": [{"mesh": 0, "skin": 0}, {"translation": [0, 0, 3]},
              {"scale": [2, 1, 1]}], "skins": [{"joints": [1, 2]}], )" +
           meshes("\"attributes\": {" + attributes + "}" + more);
}

}  // namespace

TEST_CASE("sparse accessors are read like plain ones, whatever they hold") {
    using Bytes = std::vector<std::uint8_t>;
    using Shorts = std::vector<std::uint16_t>;
    using Floats = std::vector<float>;
    Corner plain;
    plain.add("VEC3", 5126, 3, plain.bytes.add(Floats{0, 0, 0, 5, 6, 7, 0, 1, 0}));
    plain.add("VEC3", 5126, 3, plain.bytes.add(Floats{0, 1, 0, 0, 0, 0, 1, 0, 0}));
    plain.add("VEC2", 5126, 3, plain.bytes.add(Floats{0.5f, 0.25f, 1, 0, 0, 1}));
    plain.add("VEC4", 5121, 3, plain.bytes.add(Bytes{0, 0, 0, 0, 255, 51, 0, 255, 0, 0, 0, 0}),
              R"(, "normalized": true)");
    plain.add("VEC4", 5126, 3, plain.bytes.add(Floats{1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, -1}));
    plain.add("VEC4", 5123, 3, plain.bytes.add(Shorts{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}));
    plain.add("VEC4", 5126, 3, plain.bytes.add(Floats{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0}));
    plain.add("SCALAR", 5123, 6, plain.bytes.add(Shorts{0, 1, 2, 0, 2, 1}));
    const std::string image = png(std::vector<unsigned char>(12, 255));
    const auto part = [&](Corner corner, std::size_t first, std::size_t step) {
        const auto n = [&](std::size_t i) { return std::to_string(first + step * i); };
        const std::size_t view = corner.add_view(image);
        return read(corner.file(skinned("\"POSITION\": " + n(0) + ", \"NORMAL\": " + n(1) + ", \"TEXCOORD_0\": " +
                                            n(2) + ", \"COLOR_0\": " + n(3) + ", \"TANGENT\": " + n(4) +
                                            ", \"JOINTS_0\": " + n(5) + ", \"WEIGHTS_0\": " + n(6),
                                        ", \"material\": 0, \"indices\": " + n(7)) +
                                R"(, "materials": [{"normalTexture": {"index": 0}, "alphaMode": "BLEND"}],
                             "textures": [{"source": 0}], "images": [{"bufferView": )" +
                                std::to_string(view) + "}]"))
            .parts.at(0);
    };
    Corner sparse;
    add_sparse(sparse, {.type = "VEC3", .base = 0}, Bytes{1}, Floats{5, 6, 7});
    add_sparse(sparse, {.type = "VEC3"}, std::vector<std::uint32_t>{0, 2}, Floats{0, 1, 0, 1, 0, 0});
    add_sparse(sparse, {.type = "VEC2", .base = 2}, Shorts{0}, Floats{0.5f, 0.25f});
    add_sparse(sparse, {.type = "VEC4", .component = 5121, .more = R"(, "normalized": true)"}, Bytes{1},
               Bytes{255, 51, 0, 255});
    add_sparse(sparse, {.type = "VEC4"}, Bytes{0, 2}, Floats{1, 0, 0, 1, 0, 1, 0, -1});
    add_sparse(sparse, {.type = "VEC4", .component = 5123}, Bytes{1, 2}, Shorts{1, 0, 0, 0, 0, 1, 0, 0});
    add_sparse(sparse, {.type = "VEC4"}, Bytes{0, 1, 2}, Floats{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0});
    add_sparse(sparse, {.type = "SCALAR", .component = 5123, .rows = 6}, Bytes{1, 2, 4, 5}, Shorts{1, 2, 2, 1});
    const gltf::Part expected = part(plain, 5, 1), found = part(sparse, 7, 3);
    REQUIRE(expected.mesh.triangles.size() == 2);
    REQUIRE(expected.tangents.values.size() == 3);
    REQUIRE(expected.alphas.values.size() == 3);
    check_same(found, expected);
}

TEST_CASE("what is wrong with a sparse accessor is said, with its number") {
    using Bytes = std::vector<std::uint8_t>;
    const auto said_of = [](const Sparse& of, const Bytes& indices, std::size_t values) {
        Corner corner;
        const std::size_t n = add_sparse(corner, of, indices, std::vector<float>(3 * values, 0.5f));
        return said(corner.file(one_node + meshes("\"attributes\": {\"POSITION\": " + std::to_string(n) + "}")));
    };
    CHECK(said_of({.type = "VEC3"}, {0, 1, 2}, 3) == "read");
    for (const Bytes& indices : {Bytes{1, 0}, Bytes{1, 1}})
        CHECK(said_of({.type = "VEC3"}, indices, 2) ==
              "accessors[7].sparse.indices must increase strictly, but a number is not larger than the one before it");
    CHECK(said_of({.type = "VEC3"}, {0, 3}, 2) ==
          "accessors[7].sparse.indices refers to a row beyond the end of its accessor");
    CHECK(said_of({.type = "VEC3"}, {0, 1}, 1) == "accessors[7].sparse.values extends beyond the end of its bytes");
    CHECK(said_of({.type = "VEC3"}, {0, 1, 2, 3}, 4) == "accessors[7].sparse has a larger \"count\" than its accessor");
    const auto said_by = [](const std::string& sparse, const std::string& count = "3") {
        Corner corner;
        corner.add_accessor(R"({"type": "VEC3", "componentType": 5126, "count": )" + count + sparse + "}");
        return said(corner.file(one_node + meshes(R"("attributes": {"POSITION": 5}, "indices": 4)")));
    };
    CHECK(said_by(R"(, "sparse": {"count": 1})") == "accessors[5].sparse must have \"indices\" and \"values\"");
    CHECK(said_by(R"(, "sparse": {"count": 1, "indices": {"bufferView": 4, "componentType": 5122},
                     "values": {"bufferView": 0}})") ==
          "accessors[5].sparse.indices has a \"componentType\" other than 5121, 5123 and 5125");
    CHECK(said_by(R"(, "sparse": {"count": 1, "indices": {"bufferView": 99, "componentType": 5123},
                     "values": {"bufferView": 0}})")
              .find("accessors[5].sparse.indices refers to bufferViews[99]") == 0);
    CHECK(said_by(R"(, "sparse": {"count": 1, "indices": {"bufferView": 4, "byteOffset": 5, "componentType": 5123},
                     "values": {"bufferView": 0}})") ==
          "accessors[5].sparse.indices extends beyond the end of its bytes");
    // Zeros cost nothing in the file, so there is a limit.
    CHECK(said_by("") == "read");
    CHECK(said_by("", "10000000") == "read");
    CHECK(said_by("", "4000000000") == "accessors[5] has more than 10 million rows but no \"bufferView\" for them");
}

}  // namespace test_gltf_sparse
