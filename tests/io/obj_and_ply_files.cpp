// What OBJ files and PLY files alone may have.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "phasetree/io/mesh.hpp"
#include "support/written_files.hpp"

namespace test_obj_and_ply_files {

using namespace phasetree;
using namespace phasetree::tests;

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
          "a.obj: a face names a vertex that does not exist (line 4)");
    CHECK(files.said("a.obj", "v 0 0 0\r\rf 1 1 2\r") == "a.obj: a face names a vertex that does not exist (line 3)");
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
          "a.ply: a face has a vertex of which a coordinate is no number, or is too large (row 1 of its faces)");
    CHECK(files.said("a.ply", with("0 x 0 0 0 0 1")) ==
          "a.ply: there is something other than a number (row 1 of its vertices)");
}

}  // namespace test_obj_and_ply_files
