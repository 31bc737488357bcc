#include "mesh_file/ply.hpp"

#include <fmt/format.h>

#include "mesh_file/bytes_as_text.hpp"

namespace phasetree::tracer {

namespace {

// A name in a header line, which a line break would end.
std::string in_line(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 32) c = ' ';
    return name;
}

}  // namespace

std::string ply_of(const MeshedObject& object) {
    const PhaseMesh& mesh = object.mesh;
    const auto is_there = [&](const PhaseMesh::Triangle& t) {
        return object.chosen.contains(t.behind) || object.chosen.contains(t.front);
    };
    std::vector<std::uint32_t> number(mesh.vertices.size(), 0);
    std::vector<glm::vec3> vertices;
    std::size_t triangles = 0;
    for (const PhaseMesh::Triangle& t : mesh.triangles) {
        if (!is_there(t)) continue;
        ++triangles;
        for (const std::uint32_t v : t.vertices)
            if (number[v] == 0) {
                vertices.push_back(mesh.vertices[v]);
                number[v] = static_cast<std::uint32_t>(vertices.size());  // index plus one
            }
    }
    std::string head = "ply\nformat binary_little_endian 1.0\ncomment made by phasetree\n";
    for_each_phase(mesh.phases().bits, [&](int i) {
        head += fmt::format("comment phase {} {}\n", i, in_line(object.looks[static_cast<std::size_t>(i)].name));
    });
    head += fmt::format(
        "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nproperty uchar behind\nproperty uchar front\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
        vertices.size(), triangles);
    ByteWriter out;
    append_text(out, head);
    for (const glm::vec3& v : vertices)
        for (int i = 0; i < 3; ++i) out.number(v[i]);
    for (const PhaseMesh::Triangle& t : mesh.triangles) {
        if (!is_there(t)) continue;
        out.number(std::uint8_t{3});
        for (const std::uint32_t v : t.vertices) out.number(number[v] - 1);
        out.number(t.behind.index);
        out.number(t.front.index);
        for (const int c : shown_color(object.look(object.chosen.contains(t.behind) ? t.behind : t.front)))
            out.number(static_cast<std::uint8_t>(c));
    }
    return bytes_as_text(out);
}

std::string ply_of(const TriangleMesh& mesh) {
    ByteWriter out;
    append_text(out, fmt::format("ply\nformat binary_little_endian 1.0\ncomment made by phasetree\n"
                                 "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                                 "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                                 mesh.vertices.size(), mesh.triangles.size()));
    for (const glm::vec3& v : mesh.vertices)
        for (int i = 0; i < 3; ++i) out.number(v[i]);
    for (const glm::uvec3& t : mesh.triangles) {
        out.number(std::uint8_t{3});
        for (int i = 0; i < 3; ++i) out.number(t[i]);
    }
    return bytes_as_text(out);
}

}  // namespace phasetree::tracer
