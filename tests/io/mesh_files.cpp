// Meshes in files of each kind, and files that are none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "io/face_triangles.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "support/sanitizers.hpp"
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

// A face of two arms side by side, of which each corner is compared with most others before it is cut off.
std::vector<glm::vec3> spiral(int corners) {
    std::vector<glm::vec3> face;
    for (int i = 0; i < corners; ++i) {
        const int along = std::min(i, corners - 1 - i);
        const double angle = 0.3 * along, radius = 1 + 0.05 * along + (i < corners / 2 ? 0.3 : 0);
        face.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    return face;
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
    // Lines go on behind a backslash and end at a comment; what is too small for a float is 0.
    const MeshFile joined = read("a.obj", "v 0 0 1e-50\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3 # the only one\n");
    CHECK(joined.mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}});
    CHECK(joined.mesh.vertices[0].z == 0);
    // A face without normals has some of length 0 if another has some.
    const MeshFile flat = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 0\nf 1 2 3\nf 1//1 2//1 3//1\n");
    CHECK(corner(flat.normals, flat, 0, 1) == glm::vec3(0));
    CHECK(corner(flat.normals, flat, 1, 1) == glm::vec3(0, 1, 0));
    // What one face lacks, none has; a weight behind coordinates is no colour.
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
    // Those of the faces' corners come before those of the vertices.
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

TEST_CASE("faces that are not convex become triangles within them") {
    // Letters C and a star, each in several planes, from every first corner and in both senses. The triangles have the
    // same sense as the face, and their areas add up to its own, so that none is outside and none is over another.
    const std::vector<std::vector<glm::vec2>> faces{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}},
                                                    {{0, 3},
                                                     {-0.5f, 0.7f},
                                                     {-3, 1},
                                                     {-0.8f, -0.3f},
                                                     {-2, -2.5f},
                                                     {0, -0.9f},
                                                     {2, -2.5f},
                                                     {0.8f, -0.3f},
                                                     {3, 1},
                                                     {0.5f, 0.7f}},
                                                    {{0, 0}, {2, 1}, {4, 0}, {2, 4}}};
    const WrittenFiles files(read_mesh);
    for (const std::vector<glm::vec2>& face : faces)
        for (std::size_t first = 0; first < face.size(); ++first)
            for (const bool is_reversed : {false, true})
                for (const glm::vec3 slope : {glm::vec3(0, 0, 1), glm::vec3(3, 1, 0.2f), glm::vec3(-0.1f, 2, -1)}) {
                    // Three axes of a frame, of which the last is the normal.
                    const glm::vec3 normal = glm::normalize(slope);
                    const glm::vec3 x = glm::normalize(glm::cross(glm::vec3(0.3f, -0.5f, 0.8f), normal));
                    const glm::vec3 y = glm::cross(normal, x);
                    std::string text, corners = "f";
                    float area = 0;
                    for (std::size_t i = 0; i < face.size(); ++i) {
                        const std::size_t at = (first + (is_reversed ? face.size() - i : i)) % face.size();
                        const glm::vec3 p = face[at].x * x + face[at].y * y;
                        text +=
                            "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
                        corners += " " + std::to_string(i + 1);
                        const glm::vec2& next = face[(i + 1) % face.size()];
                        area += 0.5f * (face[i].x * next.y - next.x * face[i].y);
                    }
                    const TriangleMesh mesh = files.read("a.obj", text + corners + "\n");
                    REQUIRE(mesh.triangles.size() == face.size() - 2);
                    float sum = 0;
                    for (const glm::uvec3& t : mesh.triangles) {
                        const glm::vec3 &a = mesh.vertices[t.x], &b = mesh.vertices[t.y], &c = mesh.vertices[t.z];
                        const float part = 0.5f * glm::dot(glm::cross(b - a, c - a), is_reversed ? -normal : normal);
                        CHECK(part > 0);
                        sum += part;
                    }
                    CHECK(sum == doctest::Approx(area).epsilon(1e-4));
                    CHECK_FALSE(1.01f * sum == doctest::Approx(area).epsilon(1e-4));
                }
    // A face that crosses itself, and one all of whose corners are on a line, have as many triangles all the same.
    CHECK(files.read("a.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n").triangles.size() == 2);
    CHECK(files.read("a.obj", "v 0 0 0\nv 1 0 0\nv 3 0 0\nv 2 0 0\nf 1 2 3 4\n").triangles.size() == 2);
}

TEST_CASE("faces of very many corners take little time, and are whole") {
    // A comb of 500 teeth, which has few ears at a time, and a face of a hundred thousand corners.
    std::string comb, round, of_comb = "f", of_round = "f";
    for (int i = 0; i < 1000; ++i) {
        comb += "v " + std::to_string(i) + (i % 2 ? " 1 0\n" : " 100 0\n");
        of_comb += " " + std::to_string(1000 - i);
    }
    for (int i = 0; i < 100'000; ++i) {
        round += "v " + std::to_string(std::cos(6.2831853e-5 * i)) + " " + std::to_string(std::sin(6.2831853e-5 * i)) +
                 " 0\n";
        of_round += " " + std::to_string(i + 1);
    }
    CHECK(read_mesh_file("a.obj", comb + of_comb, 1'000'000).mesh.triangles.size() == 998);
    CHECK(read_mesh_file("a.obj", round + of_round, 1'000'000).mesh.triangles.size() == 99'998);
    std::string endless = "v 0 0 0\nf";
    for (int i = 0; i <= 1'000'000; ++i) endless += " 1";
    CHECK_THROWS_WITH_AS((void)read_mesh_file("a.obj", endless, 10'000'000),
                         "a.obj: a face has more than a million corners (line 2)", SceneError);
    CHECK_THROWS_WITH_AS((void)read_mesh_file("a.obj", round + of_round, 0),
                         "a.obj: there are more triangles than 0 million", SceneError);
}

TEST_CASE("what is wrong in a file is said with its place, and nothing of it is quoted") {
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.txt", obj) == "a.txt: is no mesh: its name must end with .obj, .ply or .stl");
    CHECK(files.said("a.obj", "v 0 0\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 secret\n") == "a.obj: a vertex needs three numbers (line 1)");
    CHECK(files.said("a.obj", "v 0 0 0\nf 1 1 2\n") == "a.obj: a face names a vertex that does not exist (line 2)");
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
    // A second list of vertices has no normals, which the first has.
    CHECK(files.said("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                     "z\nproperty float nx\nproperty float ny\nproperty float nz\nelement vertex 2\nproperty float "
                     "x\nproperty float y\nproperty float z\nend_header\n0 0 0 0 0 1\n1 0 0\n0 1 0\n") ==
          "a.ply: its header has two elements \"vertex\"");
    CHECK(files.said("a.stl", "no solid") ==
          "a.stl: is no STL file: it is neither as long as its number of triangles says nor a text that begins with "
          "\"solid\"");
    CHECK(files.said("a.stl", "solid\nvertex 1 2\n") == "a.stl: a vertex needs three numbers (line 2)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 3\nendfacet\n") ==
          "a.stl: a facet has less than three vertices (line 3)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2\n3 vertex 1 2\nvertex") ==
          "a.stl: a vertex needs three numbers (line 3)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 3 vertex 1 2 3 vertex 1 2 3\nVERTEX 1 2 3 endfacet\n") ==
          "a.stl: a facet has more than three vertices (line 3)");
    CHECK(files.said("a.stl", "solid\nvertex 1 2 1e39\n") ==
          "a.stl: a vertex has a coordinate that is no number, or is too large (line 2)");
    // A line of vn costs 12 bytes of memory.
    CHECK(files.said("a.obj", "v 0 0 0\nvn\n") == "a.obj: a vn line needs three numbers (line 2)");
    CHECK(files.said("a.obj", "v 0 0 0\nvn nan 0 # none\n") == "a.obj: a vn line needs three numbers (line 2)");
    CHECK(files.said("a.obj", "vt\n") == "a.obj: a vt line needs a number (line 1)");
    CHECK(files.said("a.obj", "vt nan\nvn nan nan nan\n") == "read");
}

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
    const std::string absent = "a face has a vertex of which a coordinate is no number, or is too large";
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
          "a.stl: a vertex has a coordinate that is no number, or is too large (triangle 2)");
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

TEST_CASE("STL files of words may have any white space and any case") {
    const auto read = [](const std::string& content) { return read_mesh_file("a.stl", content, 100).mesh; };
    const auto changed = [](auto&& change) {
        std::string text = word_stl();
        std::ranges::transform(text, text.begin(), change);
        return text;
    };
    const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; };
    check_tetrahedron(read(changed([](char c) { return c == '\n' ? ' ' : c; })));  // all on one line
    check_tetrahedron(read(changed([](char c) { return c == ' ' ? '\n' : c; })));  // each word on its own
    check_tetrahedron(read(changed([](char c) { return c == '\n' ? '\r' : c; })));
    check_tetrahedron(read(changed(upper)));
    check_tetrahedron(read("\n  " + word_stl()));
    // Names of all words, and one solid behind the other on each line.
    std::string text = word_stl();
    check_tetrahedron(read(text.replace(6, 4, "facet vertex 1 outer loop endfacet")));
    check_tetrahedron(read("solid nothing\nendsolid vertex endfacet\n" + word_stl()));
    const std::string line = changed([](char c) { return c == '\n' ? ' ' : c; });
    CHECK(read(line + "\n" + line + line).triangles.size() == 12);
    // Two words that stand on one line in some files.
    const std::string facet =
        "solid a facet normal 0 0 1\nouter loop vertex 0 0 0\nvertex 1 0 0 vertex\n0 1 0 endloop "
        "endfacet\nendsolid";
    CHECK(read(facet).triangles.size() == 1);
    CHECK(read(facet).vertices[1] == glm::vec3(1, 0, 0));
}

TEST_CASE("binary STL files may have bytes behind their triangles, and any header") {
    const auto read = [](const std::string& content) { return read_mesh_file("a.stl", content, 100).mesh; };
    const auto with_header = [](std::string header) {
        header.resize(80);
        return header + binary_stl().substr(80);
    };
    for (const std::string header : {"solid", "made by hand", "solid facet normal 0 0 0\n", "SOLID\r\nvertex"})
        for (const std::string& more : {std::string(), std::string(37, '\0'), std::string("facet")})
            check_tetrahedron(read(with_header(header) + more));
    // Numbers without any byte that text has not, and a text whose number of triangles would be small.
    std::string letters = std::string("solid") + std::string(75, ' ') + bytes(std::uint32_t{1}) + std::string(50, 'A');
    CHECK(read(letters + "behind").triangles.size() == 1);
    const std::string name(80 - 6, 'n');
    CHECK(read("solid " + name + bytes(std::uint32_t{1}) +
               "\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 "
               "vertex 0 1 0\nendfacet\n")
              .vertices[1] == glm::vec3(1, 0, 0));
    const std::string no_stl =
        "a.stl: is no STL file: it is neither as long as its number of triangles says nor a text that begins with "
        "\"solid\"";
    const WrittenFiles files(read_mesh);
    CHECK(files.said("a.stl", with_header("solid").substr(0, 283)) == no_stl);
    CHECK(files.said("a.stl", with_header("made by hand").substr(0, 283)) == no_stl);
}

TEST_CASE("faces that are slow to divide cost a file what is left for it, and ordinary ones nothing") {
    io::FaceDivider of_little(1'000'000);
    for (int i = 0; i < 10'000; ++i) REQUIRE(of_little.triangles(spiral(16))->size() == 14);
    int divided = 0;
    while (divided < 100 && of_little.triangles(spiral(1024))) ++divided;
    CHECK(divided < 2);
}

TEST_CASE("a file of very many faces that are slow to divide is given up" * doctest::skip(under_sanitizer)) {
    std::string text, face = "f";
    for (const glm::vec3& p : spiral(1024)) text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " 0\n";
    for (int i = 1; i <= 1024; ++i) face += " " + std::to_string(i);
    for (int i = 0; i < 10'000; ++i) text += face + "\n";
    std::string said;
    try {
        (void)read_mesh_file("a.obj", text, 100'000'000);
    } catch (const SceneError& e) {
        said = e.what();
    }
    CHECK(
        said.starts_with("a.obj: its faces of many corners take too long to divide into triangles; divide them in "
                         "the program that made the file (line "));
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
