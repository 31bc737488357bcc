// glTF files that are compressed by meshopt or by Draco, if the build has their libraries.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "gltf/draco.hpp"
#include "gltf/meshopt.hpp"
#include "tracer/gltf/gltf_corner.hpp"
#ifdef PHASETREE_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef PHASETREE_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace test_gltf_compressed {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

using Floats = std::vector<float>;

constexpr std::uint32_t side = 12;

// A wavy grid of side × side vertices.
struct Grid {
    Floats positions, normals, texture;
    std::vector<std::uint8_t> colors;
    std::vector<std::uint32_t> indices;

    Grid() {
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const auto u = static_cast<float>(x) / (side - 1), v = static_cast<float>(y) / (side - 1);
                const float slope = std::cos(7 * u), length = std::sqrt(1 + slope * slope);
                positions.insert(positions.end(), {u, v, std::sin(7 * u) / 7});
                normals.insert(normals.end(), {-slope / length, 0, 1 / length});
                texture.insert(texture.end(), {u * u, v});
                colors.insert(colors.end(),
                              {static_cast<std::uint8_t>(20 * x), static_cast<std::uint8_t>(20 * y), 7, 255});
            }
        for (std::uint32_t y = 0; y + 1 < side; ++y)
            for (std::uint32_t x = 0; x + 1 < side; ++x) {
                const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
                indices.insert(indices.end(), {a, b, d, a, d, c});
            }
    }
    std::size_t rows() const { return positions.size() / 3; }
};

const std::string attributes =
    R"("attributes": {"POSITION": 5, "NORMAL": 6, "TEXCOORD_0": 7, "COLOR_0": 8}, "indices": 9)";
const std::string normalised = R"(, "normalized": true)";

std::string plain_file(const Grid& grid) {
    Corner corner;
    corner.add("VEC3", 5126, grid.rows(), corner.bytes.add(grid.positions));
    corner.add("VEC3", 5126, grid.rows(), corner.bytes.add(grid.normals));
    corner.add("VEC2", 5126, grid.rows(), corner.bytes.add(grid.texture));
    corner.add("VEC4", 5121, grid.rows(), corner.bytes.add(grid.colors), normalised);
    corner.add("SCALAR", 5125, grid.indices.size(), corner.bytes.add(grid.indices));
    return corner.file(one_node + meshes(attributes));
}

// All data of a triangle, so that triangles can be compared regardless of their order and first corner.
using Corners = std::array<std::array<float, 11>, 3>;

std::vector<Corners> triangles_of(const std::string& file) {
    const gltf::Part part = read(file).parts.at(0);
    std::vector<Corners> all;
    for (const glm::uvec3& t : part.mesh.triangles) {
        Corners corners{};
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 &p = part.mesh.vertices[t[i]], &n = part.normals.values[t[i]],
                            &c = part.colors.values[t[i]];
            const glm::vec2& uv = part.texture.values[t[i]];
            corners[static_cast<std::size_t>(i)] = {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, c.x, c.y, c.z};
        }
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        all.push_back(corners);
    }
    std::ranges::sort(all);
    return all;
}

}  // namespace

#ifdef PHASETREE_HAS_MESHOPT

namespace {

std::string encoded_rows(const std::string& rows, std::size_t stride) {
    const std::size_t count = rows.size() / stride;
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    meshopt_encodeVertexVersion(0);
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), rows.data(),
                                            count, stride));
    return bytes;
}

template <class Number>
std::string bytes_as_text(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// A file whose views are compressed. Their uncompressed bytes are in a buffer that the file lacks, as in files of
// gltfpack.
struct Compressed {
    Corner corner{};

    void add(const std::string& type, int number, std::size_t rows, std::size_t stride, const std::string& compressed,
             const std::string& how, const std::string& more = "") {
        const std::string in_file = corner.bytes.add(
            compressed, ", \"count\": " + std::to_string(rows) + ", \"byteStride\": " + std::to_string(stride) + how);
        corner.add(type, number, rows,
                   R"({"buffer": 1, "byteLength": )" + std::to_string(rows * stride) +
                       (type == "SCALAR" ? "" : ", \"byteStride\": " + std::to_string(stride)) +
                       R"(, "extensions": {"EXT_meshopt_compression": )" + in_file + "}}",
                   more);
    }
    std::string file(const std::string& primitive) const {
        const std::string views = corner.views, accessors = corner.accessors;
        // The file's own list of buffers. The second has no bytes.
        return R"("accessors": [)" + accessors + "], \"bufferViews\": [" + views + "], " + one_node + meshes(primitive);
    }
};

std::string glb_with_fallback(const std::string& document, const std::string& bytes) {
    const std::string all =
        R"({"asset": {"version": "2.0"}, "extensionsRequired": ["EXT_meshopt_compression"],
        "buffers": [{"byteLength": )" +
        std::to_string(bytes.size()) +
        R"(}, {"byteLength": 99999, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}], )" + document +
        "}";
    const std::string chunks =
        phasetree::tests::glb_chunk(0x4E4F534A, all, ' ') + phasetree::tests::glb_chunk(0x004E4942, bytes, '\0');
    const std::uint32_t head[3] = {0x46546C67, 2, static_cast<std::uint32_t>(12 + chunks.size())};
    return std::string(reinterpret_cast<const char*>(head), sizeof head) + chunks;
}

std::string compressed_triangles(const Grid& grid) {
    std::string bytes(meshopt_encodeIndexBufferBound(grid.indices.size(), grid.rows()), '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                           grid.indices.data(), grid.indices.size()));
    return bytes;
}

Compressed compressed_grid(const Grid& grid) {
    Compressed c;
    const std::string attribute = R"(, "mode": "ATTRIBUTES")";
    c.add("VEC3", 5126, grid.rows(), 12, encoded_rows(bytes_as_text(grid.positions), 12), attribute);
    c.add("VEC3", 5126, grid.rows(), 12, encoded_rows(bytes_as_text(grid.normals), 12),
          attribute + R"(, "filter": "NONE")");
    c.add("VEC2", 5126, grid.rows(), 8, encoded_rows(bytes_as_text(grid.texture), 8), attribute);
    c.add("VEC4", 5121, grid.rows(), 4, encoded_rows(bytes_as_text(grid.colors), 4), attribute, normalised);
    c.add("SCALAR", 5125, grid.indices.size(), 4, compressed_triangles(grid), R"(, "mode": "TRIANGLES")");
    return c;
}

}  // namespace

TEST_CASE("a file that meshopt compressed has the triangles of the plain one") {
    const Grid grid;
    const Compressed c = compressed_grid(grid);
    const std::string file = glb_with_fallback(c.file(attributes), c.corner.bytes.bytes());
    CHECK(file.size() < plain_file(grid).size());
    CHECK(triangles_of(file) == triangles_of(plain_file(grid)));
    CHECK(read(file).not_shown.empty());
}

namespace {

// meshoptimizer 0.20 and later take a mode; 1 is that of earlier versions, one exponent per vector.
[[maybe_unused]] void encode_exponential(void (*encode)(void*, std::size_t, std::size_t, int, const float*),
                                         std::string& to, const Grid& grid) {
    encode(to.data(), grid.rows(), 12, 20, grid.positions.data());
}
template <class Mode>
void encode_exponential(void (*encode)(void*, std::size_t, std::size_t, int, const float*, Mode), std::string& to,
                        const Grid& grid) {
    encode(to.data(), grid.rows(), 12, 20, grid.positions.data(), static_cast<Mode>(1));
}

}  // namespace

TEST_CASE("meshopt's filters and sequences of indices") {
    Grid grid;
    // Sequences keep the order of indices; 16 bits are enough for them.
    Compressed c;
    const std::string attribute = R"(, "mode": "ATTRIBUTES", "filter": )";
    std::string exponential(12 * grid.rows(), '\0'), octahedral(4 * grid.rows(), '\0');
    encode_exponential(meshopt_encodeFilterExp, exponential, grid);
    Floats four;
    for (std::size_t i = 0; i < grid.rows(); ++i)
        four.insert(four.end(), {grid.normals[3 * i], grid.normals[3 * i + 1], grid.normals[3 * i + 2], 0});
    meshopt_encodeFilterOct(octahedral.data(), grid.rows(), 4, 8, four.data());
    c.add("VEC3", 5126, grid.rows(), 12, encoded_rows(exponential, 12), attribute + "\"EXPONENTIAL\"");
    c.add("VEC3", 5120, grid.rows(), 4, encoded_rows(octahedral, 4), attribute + "\"OCTAHEDRAL\"", normalised);
    c.add("VEC2", 5126, grid.rows(), 8, encoded_rows(bytes_as_text(grid.texture), 8), R"(, "mode": "ATTRIBUTES")");
    c.add("VEC4", 5121, grid.rows(), 4, encoded_rows(bytes_as_text(grid.colors), 4), R"(, "mode": "ATTRIBUTES")",
          normalised);
    std::string sequence(meshopt_encodeIndexSequenceBound(grid.indices.size(), grid.rows()), '\0');
    sequence.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(sequence.data()), sequence.size(),
                                                grid.indices.data(), grid.indices.size()));
    c.add("SCALAR", 5123, grid.indices.size(), 2, sequence, R"(, "mode": "INDICES")");
    const gltf::Part found = read(glb_with_fallback(c.file(attributes), c.corner.bytes.bytes())).parts.at(0);
    const gltf::Part expected = read(plain_file(grid)).parts.at(0);
    REQUIRE(found.mesh.triangles == expected.mesh.triangles);
    CHECK(found.texture.values == expected.texture.values);
    float largest_error = 0, most_turned = 0;
    for (std::size_t i = 0; i < grid.rows(); ++i) {
        largest_error = std::max(largest_error, glm::length(found.mesh.vertices[i] - expected.mesh.vertices[i]));
        most_turned = std::max(most_turned, glm::length(found.normals.values[i] - expected.normals.values[i]));
    }
    // A coordinate has 20 bits, so steps of 2⁻¹⁸ at most; a normal has 7 bits beside the sign.
    CHECK(largest_error < 4e-6f);
    CHECK(most_turned < 0.02f);
    CHECK(most_turned > 0);
}

TEST_CASE("what is wrong with data of meshopt is said") {
    const Grid grid;
    const auto said_of = [&](std::size_t count, std::size_t stride, const std::string& how, std::string bytes,
                             const std::string& primitive = attributes) {
        Compressed c = compressed_grid(grid);
        c.add("VEC3", 5126, count, stride, bytes, how);
        return said(glb_with_fallback(c.file(primitive), c.corner.bytes.bytes()));
    };
    const std::string good = encoded_rows(bytes_as_text(grid.positions), 12), mode = R"(, "mode": "ATTRIBUTES")";
    const std::string last = R"("attributes": {"POSITION": 10}, "indices": 9)";
    CHECK(said_of(grid.rows(), 12, mode, good, last) == "read");
    // Views that nothing uses are not decompressed.
    CHECK(said_of(grid.rows(), 12, mode, "no data") == "read");
    const std::string place = "bufferViews[10].extensions.EXT_meshopt_compression ";
    const std::string invalid = place + "contains invalid data; export the file again, or without meshopt compression";
    CHECK(said_of(grid.rows(), 12, mode, "no data", last) == invalid);
    CHECK(said_of(grid.rows(), 12, mode, good.substr(0, good.size() - 9), last) == invalid);
    CHECK(said_of(3 * grid.rows(), 12, mode, good, last) == invalid);
    CHECK(said_of(4'000'000'000, 12, mode, good, last) == invalid);
    const std::string layout = place + "has a \"byteStride\", \"count\" or \"filter\" that its \"mode\" does not allow";
    CHECK(said_of(grid.rows(), 0, mode, good, last) == layout);
    CHECK(said_of(grid.rows(), 13, mode, good, last) == layout);
    CHECK(said_of(grid.rows(), 260, mode, good, last) == layout);
    CHECK(said_of(grid.rows(), 12, mode + R"(, "filter": "QUATERNION")", good, last) == layout);
    CHECK(said_of(grid.rows(), 12, R"(, "mode": "TRIANGLES")", good, last) == layout);
    CHECK(said_of(grid.rows(), 12, R"(, "mode": "POINTS")", good, last) ==
          place + "has a \"mode\" other than ATTRIBUTES, TRIANGLES and INDICES");
    CHECK(said_of(grid.rows(), 12, mode + R"(, "filter": "COLOR")", good, last) ==
          place + "has a \"filter\" other than NONE, OCTAHEDRAL, QUATERNION and EXPONENTIAL");
    // Whichever byte is changed, the file is either read or rejected.
    std::size_t refused = 0;
    for (std::size_t i = 0; i < good.size(); i += 3)
        for (const char by : {'\x01', '\x80', '\xff'}) {
            std::string bad = good;
            bad[i] = static_cast<char>(bad[i] ^ by);
            refused += said_of(grid.rows(), 12, mode, bad, last) != "read";
        }
    CHECK(refused > 0);
}

#endif

#ifdef PHASETREE_HAS_DRACO

namespace {

std::string encoded(const Grid& grid, int speed, bool is_sequential, int bits = 0) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(grid.indices.size() / 3));
    const int p = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int n = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int t = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const int c = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
    for (std::uint32_t f = 0; f < grid.indices.size() / 3; ++f) {
        const std::uint32_t* const v = &grid.indices[3 * f];
        const draco::FaceIndex face(f);
        const auto add = [&](int attribute, const auto& values, std::size_t columns) {
            builder.SetAttributeValuesForFace(attribute, face, &values[columns * v[0]], &values[columns * v[1]],
                                              &values[columns * v[2]]);
        };
        add(p, grid.positions, 3);
        add(n, grid.normals, 3);
        add(t, grid.texture, 2);
        add(c, grid.colors, 4);
    }
    const auto mesh = builder.Finalize();
    REQUIRE(mesh);
    draco::Encoder encoder;
    encoder.SetSpeedOptions(speed, speed);
    encoder.SetEncodingMethod(is_sequential ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
    if (bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

std::string draco_file(const Grid& grid, const std::string& bytes, const std::string& ids, std::size_t rows,
                       const std::string& more = "", std::size_t corners = 0) {
    Corner corner;
    const auto add = [&](const std::string& type, int number, std::size_t count, const std::string& extra = "") {
        corner.add_accessor(R"({"type": ")" + type + R"(", "componentType": )" + std::to_string(number) +
                            ", \"count\": " + std::to_string(count) + extra + "}");
    };
    add("VEC3", 5126, rows);
    add("VEC3", 5126, rows);
    add("VEC2", 5126, rows);
    add("VEC4", 5121, rows, normalised);
    add("SCALAR", 5123, corners > 0 ? corners : grid.indices.size());
    const std::size_t view = corner.add_view(bytes);
    return corner.file(R"("extensionsRequired": ["KHR_draco_mesh_compression"], )" + one_node +
                       meshes(attributes + more + R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": )" +
                              std::to_string(view) + ", \"attributes\": {" + ids + "}}}"));
}

const std::string all_ids = R"("POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3)";

}  // namespace

TEST_CASE("a file that Draco compressed has the triangles of the plain one") {
    const Grid grid;
    const auto expected = triangles_of(plain_file(grid));
    for (const bool is_sequential : {false, true})
        for (const int speed : {0, 5, 10}) {
            CAPTURE(is_sequential);
            CAPTURE(speed);
            const std::string file = draco_file(grid, encoded(grid, speed, is_sequential), all_ids, grid.rows());
            CHECK(triangles_of(file) == expected);
            CHECK(read(file).not_shown.empty());
        }
    // The data of a strip are also triangles.
    CHECK(triangles_of(draco_file(grid, encoded(grid, 5, false), all_ids, grid.rows(), R"(, "mode": 5)")) == expected);
}

TEST_CASE("what Draco quantised is as near as its bits allow") {
    const Grid grid;
    const auto found = triangles_of(draco_file(grid, encoded(grid, 5, false, 11), all_ids, grid.rows()));
    const auto expected = triangles_of(plain_file(grid));
    REQUIRE(found.size() == expected.size());
    const auto middle = [](const std::vector<Corners>& all) {
        glm::dvec3 sum(0);
        for (const Corners& corners : all)
            for (const auto& c : corners) sum += glm::dvec3(c[0], c[1], c[2]);
        return sum / (3.0 * static_cast<double>(all.size()));
    };
    CHECK(found != expected);
    CHECK(glm::length(middle(found) - middle(expected)) < 0.5 / 2047);
}

TEST_CASE("what is wrong with data of Draco is said") {
    const Grid grid;
    const std::string good = encoded(grid, 5, false),
                      place = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression ";
    const auto said_of = [&](const std::string& bytes, const std::string& ids, std::size_t rows,
                             std::size_t corners = 0) { return said(draco_file(grid, bytes, ids, rows, "", corners)); };
    const std::string invalid =
        place + "contains invalid Draco data; export the file again, or without Draco compression";
    CHECK(said_of("no data", all_ids, grid.rows()) == invalid);
    CHECK(said_of("", all_ids, grid.rows()) == invalid);
    CHECK(said_of(good.substr(0, good.size() / 2), all_ids, grid.rows()) == invalid);
    CHECK(said_of(good, R"("NORMAL": 1)", grid.rows()) == place + "has no positions");
    CHECK(said_of(good, R"("POSITION": 9)", grid.rows()) == place + "has no attribute 9 in its Draco data");
    CHECK(said_of(good, R"("POSITION": 2)", grid.rows()) ==
          place + "has rows of 2 numbers in attribute 2 of its Draco data, but its accessor declares 3");
    CHECK(said_of(good, all_ids, grid.rows() - 1) ==
          place + "has more triangles, vertices or numbers in its Draco data than its accessors declare");
    CHECK(said_of(good, all_ids, grid.rows() + 1) ==
          place + "has 144 vertices and 726 indices, but its accessors declare 145 and 726");
    CHECK(said_of(good, all_ids, 4'000'000'000) == "its compressed data exceed 1 GiB in total");
    CHECK(said_of(good, all_ids, grid.rows(), 3 * grid.indices.size()) ==
          place + "has 144 vertices and 726 indices, but its accessors declare 144 and 2178");
    // Whichever byte is changed, the file is either read or rejected.
    std::size_t refused = 0;
    for (const bool is_sequential : {false, true}) {
        const std::string of = encoded(grid, 5, is_sequential);
        // The first bytes are the counts of everything.
        for (std::size_t i = 0; i < of.size(); i += i < 100 ? 1 : 7)
            for (const char by : {'\x01', '\x80', '\xff'}) {
                std::string bad = of;
                bad[i] = static_cast<char>(bad[i] ^ by);
                refused += said_of(bad, all_ids, grid.rows()) != "read";
            }
    }
    CHECK(refused > 100);
}

#endif

TEST_CASE("without its library a compressed file is rejected by name") {
    const auto required = [](const std::string& name) {
        return said(Corner().file("\"extensionsRequired\": [\"" + name + "\"], " + one_node + meshes(all_attributes)));
    };
    if (gltf::has_draco())
        CHECK(required("KHR_draco_mesh_compression") == "read");
    else
        CHECK(required("KHR_draco_mesh_compression") ==
              "it requires KHR_draco_mesh_compression, which this build cannot read without Draco's library; export it "
              "without Draco compression, or install libdraco-dev and rebuild");
    if (gltf::has_meshopt())
        CHECK(required("EXT_meshopt_compression") == "read");
    else
        CHECK(required("EXT_meshopt_compression") ==
              "it requires EXT_meshopt_compression, which this build cannot read without meshoptimizer's library; "
              "export it without meshopt compression, or install libmeshoptimizer-dev and rebuild");
}

}  // namespace test_gltf_compressed
