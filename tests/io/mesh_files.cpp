// Meshes in files of each kind, and files that are none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>

#include "phasetree/io/error.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "support/written_files.hpp"

namespace test_mesh_files {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// The four corners of a tetrahedron, and its faces.
const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.5f}};
const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

void check_tetrahedron(const TriangleMesh& mesh) {
    REQUIRE(mesh.triangles.size() == 4);
    for (std::size_t t = 0; t < 4; ++t)
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 v = mesh.vertices.at(mesh.triangles[t][i]);
            for (int k = 0; k < 3; ++k) CHECK(v[k] == corners[faces[t][i]][k]);
        }
}

std::string ply_header(const std::string& format, int vertices = 4, int rows = 4) {
    return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty uchar red\nproperty double z\nelement face " +
           std::to_string(rows) + "\nproperty list uchar int vertex_indices\nend_header\n";
}
std::string binary_ply(bool is_big) {
    std::string text = ply_header(is_big ? "binary_big_endian" : "binary_little_endian");
    for (const auto& c : corners)
        text += bytes(c[0], is_big) + bytes(c[1], is_big) + bytes(std::uint8_t{7}) +
                bytes(static_cast<double>(c[2]), is_big);
    for (const auto& f : faces)
        text += bytes(std::uint8_t{3}) + bytes(f[0], is_big) + bytes(f[1], is_big) + bytes(f[2], is_big);
    return text;
}
const std::string word_ply =
    ply_header("ascii") + "0 0 9 0\n1 0 9 0\n0 1 9 0\n0 0 9 1.5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string obj =
    "# by hand\no body\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 0 0 1.5\nvt 0 0\nvn 0 0 1\nf 1 3 2\nf 1/1 2/1 "
    "4/1\r\nf -4//1 -1//1 -2//1\nusemtl none\nf 2/1/1 3/1/1 4/1/1";

std::string binary_stl() {
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
std::string word_stl() {
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

}  // namespace

TEST_CASE("each kind of file gives the same triangles") {
    const WrittenFiles files(read_mesh);
    check_tetrahedron(files.read("a.obj", obj));
    check_tetrahedron(files.read("a.ply", word_ply));
    check_tetrahedron(files.read("b.PLY", binary_ply(false)));
    check_tetrahedron(files.read("c.ply", binary_ply(true)));
    check_tetrahedron(files.read("a.stl", binary_stl()));
    check_tetrahedron(files.read("b.stl", word_stl()));
    // A face of five corners is three triangles.
    const TriangleMesh fan = files.read("fan.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n");
    REQUIRE(fan.triangles.size() == 3);
    CHECK(fan.triangles[2] == glm::uvec3(0, 3, 4));
}

TEST_CASE("what is wrong in a file is said with its place, and nothing of it is quoted") {
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.txt", obj) == "a.txt: is no mesh: its name must end with .obj, .ply or .stl");
    CHECK(files.said("a.obj", "v 0 0\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 nan\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 secret\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 0\nf 1 1 2\n") == "a.obj: a face names a vertex that does not exist (line 2)");
    CHECK(files.said("a.obj", "v 0 0 0\nf 1 1\n") == "a.obj: a face needs three vertices (line 2)");
    CHECK(files.said("a.ply", "plx\n") == "a.ply: is no PLY file: it does not begin with \"ply\" (line 1)");
    CHECK(files.said("a.ply", "ply\nformat ascii 1.0\n") == "a.ply: the header has no end (line 3)");
    // Billions of rows are not believed.
    CHECK(files.said("a.ply", ply_header("binary_little_endian", 2'000'000'000)) ==
          "a.ply: is shorter than its header says");
    std::string text = word_ply;
    CHECK(files.said("a.ply", text.replace(text.size() - 2, 1, "9")) ==
          "a.ply: a face names a vertex that does not exist (row 4 of its faces)");
    text = binary_ply(false);
    text.pop_back();
    CHECK(files.said("a.ply", text) == "a.ply: the file ends too early (row 4 of its faces)");
    CHECK(files.said("a.stl", "no solid") ==
          "a.stl: is no STL file: it is neither as long as its number of triangles says nor a text that begins with "
          "\"solid\"");
    CHECK(files.said("a.stl", "solid\nvertex 1 2\n") == "a.stl: a vertex needs three numbers (line 2)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 3\nendfacet\n") ==
          "a.stl: a facet has less than three vertices (line 3)");
}

TEST_CASE("every shortened file is read or refused") {
    const WrittenFiles files(read_mesh);
    for (const auto& [name, content] :
         {std::pair{"a.obj", obj}, {"a.ply", word_ply}, {"b.ply", binary_ply(true)}, {"a.stl", word_stl()}}) {
        std::size_t refused = 0;
        for (std::size_t n = 0; n < content.size(); ++n) refused += files.said(name, content.substr(0, n)) != "read";
        CHECK(refused > 0);
    }
}

TEST_CASE("a scene has a mesh beside it, and says where it names one that is no solid") {
    const WrittenFiles files(read_mesh);
    std::ofstream(files.path() / "solid.obj") << obj;
    std::ofstream(files.path() / "open.obj") << obj.substr(0, obj.rfind("f "));
    const auto scene = [&](const std::string& file) {
        return Document::from_text(
            "{\"version\": 1, \"phases\": {\"a\": {}}, \"tree\": {\"set\": {\"phase\": \"a\", \"of\":\n"
            "{\"mesh\": {\"file\": \"" +
            (files.path() / file).string() + "\"}}}}}");
    };
    const SceneTree tree = read_tree(scene("solid.obj"));
    CHECK(bounds(tree.object).high.z == doctest::Approx(1.5f));
    CHECK(write_tree(tree).find("solid.obj") != std::string::npos);
    std::string said;
    try {
        (void)read_tree(scene("open.obj"));
    } catch (const SceneError& e) {
        said = e.what();
    }
    CAPTURE(said);
    CHECK(said.find(":2:2: mesh: ") != std::string::npos);
    CHECK(said.find("is not closed: the edge from ") != std::string::npos);
}

}  // namespace test_mesh_files
