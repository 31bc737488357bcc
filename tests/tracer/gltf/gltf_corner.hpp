// glTF files of one triangle for tests, and the results of reading them.
#pragma once

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <fstream>
#include <glm/glm.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "gltf/read_gltf.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "tracer/support/written_glb.hpp"

namespace phasetree::tracer::tests {

using phasetree::tests::glb;
using phasetree::tests::GlbBytes;

// A triangle, (0,0,0) (1,0,0) (0,1,0), with tilted normals, texture coordinates and colours: accessors 0 to 3. The
// indices are accessor 4.
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
    // Adds an accessor given as text; returns its number.
    std::size_t add_accessor(const std::string& json) {
        accessors += ", " + json;
        views += ", " + bytes.add(std::string());  // accessors and views have the same numbers
        return count_++;
    }
    // The number of the last accessor and view.
    std::size_t last() const { return count_ - 1; }
    // Adds bytes that no accessor reads, such as an image; returns the number of the view.
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

inline const std::string all_attributes =
    R"("attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3}, "indices": 4)";
inline const std::string one_node = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], )";

inline std::string meshes(const std::string& primitive) {
    return R"("meshes": [{"primitives": [{)" + primitive + "}]}]";
}

inline gltf::GltfFile read(const std::string& content, const gltf::Limits& limits = {}) {
    return gltf::read_gltf(content, gltf::ReadMaterials::all, limits);
}

// The only part of a file with a triangle of this material.
inline gltf::Part part_of(const std::string& material, const Corner& corner = {}, const std::string& more = "") {
    gltf::GltfFile file = read(corner.file(one_node + meshes(all_attributes + R"(, "material": 0)") +
                                           R"(, "materials": [)" + material + "]" + more));
    REQUIRE(file.parts.size() == 1);
    return std::move(file.parts[0]);
}

inline std::string said(const std::string& content, const gltf::Limits& limits = {}) {
    try {
        (void)read(content, limits);
    } catch (const gltf::GltfError& e) {
        return e.what();
    }
    return "read";
}

// Checks that two parts have the same triangles and the same values at their vertices, bit for bit.
inline void check_same(const gltf::Part& a, const gltf::Part& b) {
    CHECK(a.mesh.vertices == b.mesh.vertices);
    CHECK(a.mesh.triangles == b.mesh.triangles);
    CHECK(a.normals.values == b.normals.values);
    CHECK(a.texture.values == b.texture.values);
    CHECK(a.second_texture.values == b.second_texture.values);
    CHECK(a.colors.values == b.colors.values);
    CHECK(a.alphas.values == b.alphas.values);
    CHECK(a.tangents.values == b.tangents.values);
}

inline bool is_near(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-5f;
}

inline std::string bytes_of(const std::string& path) {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
}

// A PNG of 2×2 pixels, from the upper left one to the lower right one.
inline std::string png(const std::vector<unsigned char>& pixels) {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = (folder / "a.png").string();
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out);
    REQUIRE(out->open(path, OIIO::ImageSpec(2, 2, 3, OIIO::TypeDesc::UINT8)));
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
    out->close();
    return bytes_of(path);
}

}  // namespace phasetree::tracer::tests
