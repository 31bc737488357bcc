// Features that only OBJ files or only PLY files have.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "phasetree/io/mesh.hpp"
#include "support/written_files.hpp"
#include "tetrahedron_files.hpp"

namespace test_obj_and_ply_files {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// The numbers of rows of lists, as a PLY file of any format has them.
std::string list_rows(const std::string& format, const std::vector<std::vector<int>>& rows) {
    std::string text;
    for (const auto& row : rows) {
        if (format == "ascii") {
            text += std::to_string(row.size());
            for (const int i : row) text += " " + std::to_string(i);
            text += "\n";
        } else {
            const bool is_big = format == "binary_big_endian";
            text += bytes(static_cast<int>(row.size()), is_big);
            for (const int i : row) text += bytes(i, is_big);
        }
    }
    return text;
}

std::string vertex_rows(const std::string& format) {
    std::string text;
    for (const auto& c : corners)
        for (const float x : c)
            text += format == "ascii" ? std::to_string(x) + " " : bytes(x, format == "binary_big_endian");
    return text;
}

// A PLY file of the tetrahedron's corners and of lists, which precede the corners or follow them.
std::string lists_ply(const std::string& format, const std::string& element, const std::vector<std::vector<int>>& rows,
                      bool vertices_first) {
    const std::string vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string lists =
        "element " + element + " " + std::to_string(rows.size()) + "\nproperty list int int vertex_indices\n";
    const std::string between = "element other 1\nproperty list int int numbers\n";
    const std::string head = "ply\nformat " + format + " 1.0\n", end = "end_header\n";
    const std::string of_lists = list_rows(format, rows), of_between = list_rows(format, {{7, 8}});
    if (vertices_first) return head + vertices + between + lists + end + vertex_rows(format) + of_between + of_lists;
    return head + lists + between + vertices + end + of_lists + of_between + vertex_rows(format);
}

const std::vector<std::string> formats{"ascii", "binary_little_endian", "binary_big_endian"};

}  // namespace

TEST_CASE("lines of OBJ files go on behind a backslash, whatever they are and however they end") {
    const std::string text =
        "v 0 \\\n0 0\nv 1 0\\\n 0\nv 1 1 \\ \n0\nv 0 1 0\nvt 0\\\n0\nvt 1 0\nvt 1 1\nvn 0 \\\n\\\n0 1\nf 1/1/1 2/2/1 "
        "3/3/1\\\n4/1/1\n# no\\\nf 1 2 3\n";
    std::string feeds_and_returns, returns;
    for (const char c : text) {
        feeds_and_returns += c == '\n' ? "\r\n" : std::string(1, c);
        returns += c == '\n' ? '\r' : c;
    }
    for (const std::string& content : {text, feeds_and_returns, returns, "\xef\xbb\xbf" + text}) {
        CAPTURE(content);
        const MeshFile file = read_mesh_file("a.obj", content, 100);
        CHECK(file.mesh.vertices == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        CHECK(file.mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
        CHECK(file.normals.values[0] == glm::vec3(0, 0, 1));
    }
    // A line's number is that of the line in which its last word is.
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.obj", "v 0 0 0\r\n\r\nf 1 1 \\\r\n2\r\n") ==
          "a.obj: a face refers to a vertex that does not exist (line 4)");
    CHECK(files.said("a.obj", "v 0 0 0\r\rf 1 1 2\r") ==
          "a.obj: a face refers to a vertex that does not exist (line 3)");
    CHECK(files.said("a.obj", "v 0 0 \\") == "a.obj: a vertex needs three numbers (line 1)");
}

TEST_CASE("numbers of PLY files that are none matter only where they are wanted") {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
        "quality\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n";
    const auto with = [&](const std::string& first) {
        return head + first + "\n1 0 0 -nan(ind) 0 0 1\n0 1 0 inf 0 0 1\n3 0 1 2\n";
    };
    const MeshFile mesh = read_mesh_file("a.ply", with("0 0 0 nan nan 0 1"), 100);
    CHECK(mesh.normals.values[0] == glm::vec3(0));
    CHECK(mesh.normals.values[1] == glm::vec3(0, 0, 1));
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.ply", with("0 nan 0 0 0 0 1")) ==
          "a.ply: a face has a vertex with a coordinate that is not a number, or too large (row 1 of its faces)");
    CHECK(files.said("a.ply", with("0 x 0 0 0 0 1")) == "a.ply: expected a number (row 1 of its vertices)");
}

TEST_CASE("elements of PLY files may come in any order") {
    const std::vector<std::vector<int>> rows{{0, 2, 1}, {0, 1, 3}, {2, 0}, {0, 3, 2}, {1, 2, 3}};
    for (const std::string& format : formats) {
        CAPTURE(format);
        check_tetrahedron(read_mesh_file("a.ply", lists_ply(format, "face", rows, true), 100).mesh);
        check_tetrahedron(read_mesh_file("a.ply", lists_ply(format, "face", rows, false), 100).mesh);
        const WrittenFiles files(read_mesh);
        for (const bool vertices_first : {true, false}) {
            CHECK(files.said("a.ply", lists_ply(format, "face", {{0, 1, 2}, {0, 1, 4}}, vertices_first)) ==
                  "a.ply: a face refers to a vertex that does not exist (row 2 of its faces)");
            std::string cut = lists_ply(format, "face", rows, vertices_first);
            cut.resize(cut.size() - (format == "ascii" ? 12 : 1));
            CHECK(files.said("a.ply", cut) != "read");
        }
    }
    // Texture coordinates of vertices and of the faces' corners, both behind the faces.
    const std::string texture_of_vertices =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
        "end_header\n";
    const MeshFile of_vertices =
        read_mesh_file("a.ply",
                       "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n" +
                           texture_of_vertices + "3 0 1 2\n0 0 0 0.5 0.25\n1 0 0 1 0\n0 1 0 0 1\n",
                       100);
    CHECK(of_vertices.texture.at(of_vertices.mesh.triangles, 0, 0) == glm::vec2(0.5f, 0.25f));
    const MeshFile of_corners = read_mesh_file(
        "a.ply",
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float "
        "texcoord\n" +
            texture_of_vertices + "3 0 1 2 6 0.125 0 1 0 0 1\n0 0 0 9 9\n1 0 0 9 9\n0 1 0 9 9\n",
        100);
    CHECK(of_corners.texture.at(of_corners.mesh.triangles, 0, 0) == glm::vec2(0.125f, 0));
}

TEST_CASE("triangle strips of PLY files turn every other triangle, and begin again after -1") {
    const WrittenFiles files(read_mesh);
    for (const std::string& format : formats)
        for (const bool vertices_first : {true, false}) {
            CAPTURE(format);
            const auto read = [&](const std::vector<std::vector<int>>& rows) {
                return read_mesh_file("a.ply", lists_ply(format, "tristrips", rows, vertices_first), 100)
                    .mesh.triangles;
            };
            CHECK(read({{0, 2, 1, 3}}) == std::vector<glm::uvec3>{{0, 2, 1}, {1, 2, 3}});
            CHECK(read({{3, 0, 1, 2, 3}}) == std::vector<glm::uvec3>{{3, 0, 1}, {1, 0, 2}, {1, 2, 3}});
            // Each strip begins with a triangle that is not turned. Strips of fewer than three corners are nothing.
            CHECK(read({{-1, 0, 2, 1, 3, -1, -1, 0, 1, -1, 0, 1, 3, -1}, {0, 3, 2}}) ==
                  std::vector<glm::uvec3>{{0, 2, 1}, {1, 2, 3}, {0, 1, 3}, {0, 3, 2}});
            // A repeated corner turns the strip elsewhere.
            CHECK(read({{0, 2, 1, 1, 0, 3}}) == std::vector<glm::uvec3>{{0, 2, 1}, {0, 1, 3}});
            CHECK(files.said("a.ply", lists_ply(format, "tristrips", {{0, 1, 2}, {0, 1, 4}}, vertices_first)) ==
                  "a.ply: a triangle strip refers to a vertex that does not exist (row 2 of its triangle strips)");
            CHECK(files.said("a.ply", lists_ply(format, "tristrips", {{0, 1, -2}}, vertices_first)) ==
                  "a.ply: a triangle strip refers to a vertex that does not exist (row 1 of its triangle strips)");
        }
    CHECK_THROWS_WITH_AS((void)read_mesh_file("a.ply", lists_ply("ascii", "tristrips", {{0, 1, 2, 3}}, true), 1),
                         "a.ply: there are more than 0 million triangles", SceneError);
}

TEST_CASE("faces of OBJ files may precede what they name") {
    const std::string values = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5\n";
    check_tetrahedron(read_mesh_file("a.obj", "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n" + values, 100).mesh);
    // The first two faces are in the middle; a negative number counts back from its own line in any case.
    check_tetrahedron(
        read_mesh_file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\nf -3 2 4\nf 1 4 -1\nv 0 0 1.5\nf -3 -2 -1", 100)
            .mesh);
    const MeshFile file = read_mesh_file("a.obj",
                                         "v 0 0 0\nv 1 0 0\nvt 0.5 0\nvn 0 0 1\nf 1/-1/-1 2/2/2 \\\n3/1/1\nv 0 1 0\n"
                                         "vt 0.25 0\nvn 1 0 0\nf 1/-1/-1 2/-2/-2 3/1/1\n",
                                         100);
    REQUIRE(file.mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 1, 2}});
    CHECK(file.texture.triangles == std::vector<glm::uvec3>{{0, 1, 0}, {1, 0, 0}});
    CHECK(file.normals.triangles == std::vector<glm::uvec3>{{0, 1, 0}, {1, 0, 0}});
    // Texture coordinates alone may follow, too.
    const MeshFile late = read_mesh_file("a.obj", values + "f 1/1 2/2 3/3\nvt 0 0\nvt 1 0\nvt 0 1\n", 100);
    CHECK(late.texture.triangles == std::vector<glm::uvec3>{{0, 1, 2}});

    const WrittenFiles files(read_mesh);
    const auto missing = [](int line) {
        return "a.obj: a face refers to a vertex that does not exist (line " + std::to_string(line) + ")";
    };
    CHECK(files.said("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\n") == missing(1));
    CHECK(files.said("a.obj", "f 1 2 3\nf 4 4 4\n" + values + "f 1 2 5\n") == missing(7));
    CHECK(files.said("a.obj", "v 0 0 0\nf 1 -2 3\n" + values) == missing(2));
    CHECK(files.said("a.obj", "f 0 1 2\n" + values) == missing(1));
    CHECK(files.said("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv nan 0 0\n") ==
          "a.obj: a face has a vertex with a coordinate that is not a number, or too large (line 1)");
    CHECK(files.said("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0\n") == "a.obj: a vertex needs three numbers (line 3)");
}

}  // namespace test_obj_and_ply_files
