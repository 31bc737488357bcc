// A tetrahedron as a file of each kind, and a check whether a mesh is this tetrahedron.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "phasetree/nodes/fields/triangle_mesh.hpp"
#include "support/written_files.hpp"

namespace phasetree::tests {

/// The four corners of a tetrahedron, and its faces.
inline const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.5f}};
inline const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline void check_tetrahedron(const TriangleMesh& mesh) {
    REQUIRE(mesh.triangles.size() == 4);
    for (std::size_t t = 0; t < 4; ++t)
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 v = mesh.vertices.at(mesh.triangles[t][i]);
            for (int k = 0; k < 3; ++k) CHECK(v[k] == corners[faces[t][i]][k]);
        }
}

inline std::string ply_header(const std::string& format, int vertices = 4, int rows = 4) {
    return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty uchar red\nproperty double z\nelement face " +
           std::to_string(rows) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string binary_ply(bool is_big) {
    std::string text = ply_header(is_big ? "binary_big_endian" : "binary_little_endian");
    for (const auto& c : corners)
        text += bytes(c[0], is_big) + bytes(c[1], is_big) + bytes(std::uint8_t{7}) +
                bytes(static_cast<double>(c[2]), is_big);
    for (const auto& f : faces)
        text += bytes(std::uint8_t{3}) + bytes(f[0], is_big) + bytes(f[1], is_big) + bytes(f[2], is_big);
    return text;
}
inline const std::string word_ply =
    ply_header("ascii") + "0 0 9 0\n1 0 9 0\n0 1 9 0\n0 0 9 1.5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
inline const std::string obj =
    "# by hand\no body\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 0 0 1.5\nvt 0 0\nvn 0 0 1\nf 1 3 2\nf 1/1 2/1 "
    "4/1\r\nf -4//1 -1//1 -2//1\nusemtl none\nf 2/1/1 3/1/1 4/1/1";

inline std::string binary_stl() {
    std::string text = "solid, but of numbers";
    text.resize(80);
    text += bytes(std::uint32_t{4});
    for (const auto& f : faces) {
        text += std::string(12, '\0');
        for (const int i : f)
            for (const float x : corners[i]) text += bytes(x);
        text += std::string(2, '\0');
    }
    return text;
}
inline std::string word_stl() {
    std::string text = "solid body\n";
    for (const auto& f : faces) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const int i : f) {
            text += "   vertex";
            for (const float x : corners[i]) text += " " + std::to_string(x);
            text += "\n";
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid body\n";
}

}  // namespace phasetree::tests
