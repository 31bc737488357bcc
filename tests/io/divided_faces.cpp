// Faces of many corners, and how they become triangles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "io/geometry/face_triangles.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/io/mesh.hpp"
#include "support/sanitizers.hpp"
#include "support/written_files.hpp"

namespace test_divided_faces {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

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
    // Faces that cross themselves, or whose corners all lie on a line, still have as many triangles.
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
                         "a.obj: there are more than 0 million triangles", SceneError);
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
    CHECK(said.starts_with(
        "a.obj: its faces with many corners take too long to triangulate; triangulate them before exporting (line "));
}

}  // namespace test_divided_faces
