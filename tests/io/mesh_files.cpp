// Meshes in files of each kind, and invalid files.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "phasetree/io/error.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/io/write.hpp"
#include "support/written_files.hpp"
#include "tetrahedron_files.hpp"

namespace test_mesh_files {

using namespace phasetree;
using namespace phasetree::tests;

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

TEST_CASE("what files say of the corners of triangles") {
    const auto read = [](const std::string& name, const std::string& content) {
        return read_mesh_file(name, content, 100);
    };
    const auto corner = [](const auto& values, const MeshFile& file, std::size_t triangle, int i) {
        return values.at(file.mesh.triangles, triangle, i);
    };
    const std::string vertices = "v 0 0 0 1 0 0.5\nv 1 0 0 0 1 0.5\nv 0 1 0 0 0 1\nv 1 1 0 0 0 0\n";
    const MeshFile obj = read("a.obj", vertices +
                                           "vt 0 0.25\nvt 1 0 0\nvt 0 1\nvn 0 0 2\nvn 1 0 0\n"
                                           "f 1/1/1 2/2/1 3/-1/-1\nf 2/2/2 4/3/2 3/1/2\n");
    REQUIRE(obj.mesh.triangles.size() == 2);
    CHECK(corner(obj.texture, obj, 0, 0) == glm::vec2(0, 0.25f));
    CHECK(corner(obj.texture, obj, 0, 2) == glm::vec2(0, 1));
    CHECK(corner(obj.texture, obj, 1, 1) == glm::vec2(0, 1));
    CHECK(corner(obj.normals, obj, 0, 0) == glm::vec3(0, 0, 2));
    CHECK(corner(obj.normals, obj, 0, 2) == glm::vec3(1, 0, 0));
    CHECK(corner(obj.colors, obj, 1, 0) == glm::vec3(0, 1, 0.5f));
    // Normals that are no numbers, and coordinates of one number, are 0 there.
    const MeshFile odd = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nvn -nan(ind) 0 1\nf 1/1/1 2/1/1 3/1/1\n");
    CHECK(corner(odd.texture, odd, 0, 0) == glm::vec2(0.5f, 0));
    CHECK(corner(odd.normals, odd, 0, 0) == glm::vec3(0, 0, 1));
    // A backslash continues a line, and a comment ends it; numbers too small for a float are 0.
    const MeshFile joined = read("a.obj", "v 0 0 1e-50\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3 # the only one\n");
    CHECK(joined.mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}});
    CHECK(joined.mesh.vertices[0].z == 0);
    // A face without normals gets normals of length 0 if another face has normals.
    const MeshFile flat = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 0\nf 1 2 3\nf 1//1 2//1 3//1\n");
    CHECK(corner(flat.normals, flat, 0, 1) == glm::vec3(0));
    CHECK(corner(flat.normals, flat, 1, 1) == glm::vec3(0, 1, 0));
    // Attributes that one face lacks are dropped for all; a weight after coordinates is not a colour.
    const MeshFile lacking = read("a.obj", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nvt 0 0\nf 1/1 2/1 3/1\nf 1 2 3/1\n");
    CHECK(lacking.texture.empty());
    CHECK(lacking.normals.empty());
    CHECK(lacking.colors.empty());

    const MeshFile ply =
        read("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
             "z\nproperty ushort red\nproperty ushort green\nproperty ushort blue\nproperty float nx\nproperty float "
             "ny\nproperty float nz\nproperty float u\nproperty float v\nelement face 1\nproperty list uchar int "
             "vertex_index\nend_header\n0 0 0 65535 0 13107 0 0 1 0.5 0\n1 0 0 0 0 0 0 1 0 0 0.5\n0 1 0 0 0 0 1 0 0 1 "
             "1\n3 0 2 1\n");
    CHECK(corner(ply.colors, ply, 0, 0) == glm::vec3(1, 0, 0.2f));
    CHECK(corner(ply.normals, ply, 0, 1) == glm::vec3(1, 0, 0));
    CHECK(corner(ply.texture, ply, 0, 2) == glm::vec2(0, 0.5f));
    // Values at the corners of faces take precedence over those of the vertices.
    const MeshFile wedges =
        read("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty "
             "float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\nproperty list uchar "
             "float texcoord\nend_header\n0 0 0 9 9\n1 0 0 9 9\n1 1 0 9 9\n0 1 0 9 9\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 "
             "2 3 6 0 0.5 1 1 0.5 1\n");
    REQUIRE(wedges.mesh.triangles.size() == 3);
    for (int i = 0; i < 3; ++i)
        CHECK(corner(wedges.texture, wedges, 1, i) == glm::vec2(wedges.mesh.vertices[wedges.mesh.triangles[1][i]]));
    CHECK(corner(wedges.texture, wedges, 2, 0) == glm::vec2(0, 0.5f));
    CHECK(read("a.stl", word_stl()).normals.empty());
}

TEST_CASE("what is wrong in a file is said with its place, and nothing of it is quoted") {
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.txt", obj) == "a.txt: is not a mesh: its name must end in .obj, .ply or .stl");
    CHECK(files.said("a.obj", "v 0 0\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 secret\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 0\nf 1 1 2\n") == "a.obj: a face refers to a vertex that does not exist (line 2)");
    CHECK(files.said("a.ply", "plx\n") == "a.ply: is not a PLY file: it does not begin with \"ply\" (line 1)");
    CHECK(files.said("a.ply", "ply\nformat ascii 1.0\n") == "a.ply: the header has no end (line 3)");
    // A header that claims billions of rows is not trusted.
    CHECK(files.said("a.ply", ply_header("binary_little_endian", 2'000'000'000)) ==
          "a.ply: is shorter than its header declares");
    std::string text = word_ply;
    CHECK(files.said("a.ply", text.replace(text.size() - 2, 1, "9")) ==
          "a.ply: a face refers to a vertex that does not exist (row 4 of its faces)");
    text = binary_ply(false);
    text.pop_back();
    CHECK(files.said("a.ply", text) == "a.ply: the file ends too early (row 4 of its faces)");
    // A second list of vertices has no normals, which the first has.
    CHECK(files.said("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                     "z\nproperty float nx\nproperty float ny\nproperty float nz\nelement vertex 2\nproperty float "
                     "x\nproperty float y\nproperty float z\nend_header\n0 0 0 0 0 1\n1 0 0\n0 1 0\n") ==
          "a.ply: its header has two elements \"vertex\"");
    CHECK(files.said("a.stl", "no solid") ==
          "a.stl: is not an STL file: its length does not match its number of triangles, and it does not begin with "
          "\"solid\"");
    CHECK(files.said("a.stl", "solid\nvertex 1 2\n") == "a.stl: a vertex needs three numbers (line 2)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 3\nendfacet\n") ==
          "a.stl: a facet has fewer than three vertices (line 3)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2\n3 vertex 1 2\nvertex") ==
          "a.stl: a vertex needs three numbers (line 3)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 3 vertex 1 2 3 vertex 1 2 3\nVERTEX 1 2 3 endfacet\n") ==
          "a.stl: a facet has more than three vertices (line 3)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 1e39\n") ==
          "a.stl: a vertex has a coordinate that is not a number, or too large (line 2)");
    // A line of vn costs 12 bytes of memory.
    CHECK(files.said("a.obj", "v 0 0 0\nvn\n") == "a.obj: a vn line needs three numbers (line 2)");
    CHECK(files.said("a.obj", "v 0 0 0\nvn nan 0 # none\n") == "a.obj: a vn line needs three numbers (line 2)");
    CHECK(files.said("a.obj", "vt\n") == "a.obj: a vt line needs a number (line 1)");
    CHECK(files.said("a.obj", "vt nan\nvn nan nan nan\n") == "read");
}

TEST_CASE("a byte order mark hides nothing, and lines may end with a carriage return") {
    const std::string mark = "\xef\xbb\xbf";
    check_tetrahedron(read_mesh_file("a.obj", mark + obj.substr(obj.find("v ")), 100).mesh);
    check_tetrahedron(read_mesh_file("a.ply", mark + word_ply, 100).mesh);
    check_tetrahedron(read_mesh_file("a.ply", mark + binary_ply(true), 100).mesh);
    check_tetrahedron(read_mesh_file("a.stl", mark + word_stl(), 100).mesh);
    const auto returned = [](std::string text) {
        std::ranges::replace(text, '\n', '\r');
        return text;
    };
    check_tetrahedron(read_mesh_file("a.ply", returned(word_ply), 100).mesh);
    check_tetrahedron(read_mesh_file("a.stl", returned(word_stl()), 100).mesh);
}

TEST_CASE("loose edges are no faces, and vertices that no face has may be anything") {
    const WrittenFiles files(read_mesh);
    const std::string absent = "a face has a vertex with a coordinate that is not a number, or too large";
    for (const std::string none : {"nan 0 0", "5 -nan(ind) 0", "5 0 1e39", "1e999 0 0", "5 -1.#IND 0", "-inf 5 5"}) {
        const std::string text = "v 2 2 2\nv " + none + "\nv 3 2 2\nv 2 3 2\nf 1 2\nf 2\nf\nf 1 3 4\n";
        const MeshFile file = read_mesh_file("a.obj", text, 100);
        CHECK(file.mesh.triangles == std::vector<glm::uvec3>{{0, 2, 3}});
        // It is put where a triangle is.
        CHECK(file.mesh.vertices[1] == glm::vec3(2));
        CHECK(files.said("a.obj", text + "f 1 4 2\n") == "a.obj: " + absent + " (line 9)");
    }
    CHECK(files.said("a.obj", "v 0 0 --1\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(read_mesh_file("a.obj", "v 0 0 nan\n", 100).mesh.vertices[0] == glm::vec3(0));

    const auto ply = [](const std::string& first, const std::string& face) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty float "
               "z\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n" +
               first + "\n2 2 2\n3 2 2\n2 3 2\n0\n1 0\n2 0 1\n3 1 2 3\n" + face;
    };
    for (const std::string none : {"nan 0 0", "1e300 0 0", "0 0 1e39"}) {
        const MeshFile file = read_mesh_file("a.ply", ply(none, "1 9\n"), 100);
        CHECK(file.mesh.triangles == std::vector<glm::uvec3>{{1, 2, 3}});
        CHECK(file.mesh.vertices[0] == glm::vec3(2));
        CHECK(files.said("a.ply", ply(none, "3 1 2 0\n")) == "a.ply: " + absent + " (row 5 of its faces)");
    }
    std::string stl = binary_stl();
    const float infinite = std::numeric_limits<float>::infinity();
    std::memcpy(stl.data() + 84 + 50 + 12, &infinite, 4);
    CHECK(files.said("a.stl", stl) ==
          "a.stl: a vertex has a coordinate that is not a number, or too large (triangle 2)");
}

TEST_CASE("colours and texture coordinates are there if all triangles have them") {
    const std::string colored = "v 5 5 5\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 9 9 9\n";
    const MeshFile obj = read_mesh_file("a.obj", colored + "f 2 3 4\n", 100);
    REQUIRE(obj.colors.values.size() == obj.mesh.vertices.size());
    CHECK(obj.colors.at(obj.mesh.triangles, 0, 1) == glm::vec3(0, 1, 0));
    CHECK(obj.colors.values[0] == glm::vec3(0));
    CHECK(obj.colors.values[4] == glm::vec3(0));
    CHECK(read_mesh_file("a.obj", colored + "f 2 3 4\nf 2 3 5\n", 100).colors.empty());

    const auto ply = [](const std::string& faces) {
        return read_mesh_file(
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
            "float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\nproperty list uchar "
            "float texcoord\nend_header\n0 0 0 0.5 0.25\n1 0 0 1 0\n0 1 0 0 1\n" +
                faces,
            100);
    };
    const MeshFile empty = ply("3 0 1 2 0\n3 0 2 1 0\n");
    REQUIRE_FALSE(empty.texture.empty());
    CHECK(empty.texture.at(empty.mesh.triangles, 0, 0) == glm::vec2(0.5f, 0.25f));
    CHECK(empty.texture.at(empty.mesh.triangles, 1, 1) == glm::vec2(0, 1));
    CHECK(ply("3 0 1 2 0\n3 0 2 1 6 0 0 1 1 0 0\n").texture.empty());
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
    std::ofstream(files.path() / "sheet.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
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
        (void)read_tree(scene("sheet.obj"));
    } catch (const SceneError& e) {
        said = e.what();
    }
    CAPTURE(said);
    CHECK(said.find(":2:2: mesh: ") != std::string::npos);
    CHECK(said.find("sheet.obj is a sheet that encloses nothing: ") != std::string::npos);
}

}  // namespace test_mesh_files
