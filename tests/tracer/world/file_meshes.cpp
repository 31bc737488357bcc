// Meshes from files beside the object: their placement and their shading normals.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "tracer/support/paths.hpp"

namespace test_file_meshes {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string far_away =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0, 0, -99], "of": {"sphere": {"radius": 1}}}}}})";

// A file with this content as a mesh, with these parameters.
class FileMesh {
  public:
    FileMesh(const std::string& kind, const std::string& content, const std::string& more = "") {
        phasetree::support::write_text(folder_ / ("a." + kind), content);
        scene_ = scene_of(R"("a": {"diffuse": {"color": [1, 1, 1]}})", far_away,
                          std::string(white_environment) + R"(, "meshes": [{")" + kind + R"(": {"file": ")" +
                              (folder_ / ("a." + kind)).string() + "\"" + more +
                              R"(, "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
    }
    const Mesh& mesh() const { return scene_.meshes.at(0); }
    Surface seen_from(const glm::vec3& origin, const glm::vec3& direction) const {
        const auto surface = surface_met(World(scene_), origin, direction);
        REQUIRE(surface);
        return *surface;
    }

  private:
    phasetree::support::TemporaryDirectory folder_;
    Scene scene_;
};

bool is_near(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-5f;
}

// A square in the plane z = 0 whose normals lean along x, more so at the right.
const std::string leaning =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 3\nvn 0.6 0 0.8\nf 1//1 2//2 3//2\nf 1//1 3//2 4//1\n";

}  // namespace

TEST_CASE("shading normals are those of the file, and turned with it") {
    const glm::vec3 leaning_half = glm::normalize(glm::vec3(0, 0, 1) + glm::vec3(0.6f, 0, 0.8f));
    const FileMesh plain("obj", leaning);
    CHECK(is_near(plain.seen_from({0.5f, 0.5f, 9}, {0, 0, -1}).normal, leaning_half));
    CHECK(is_near(plain.seen_from({0.5f, 0.5f, 9}, {0, 0, -1}).geometric_normal, {0, 0, 1}));
    CHECK(is_near(plain.seen_from({0.5f, 0.5f, -9}, {0, 0, 1}).normal, -leaning_half));
    // A quarter turn maps x to y. The square is then at x from −1 to 0, and at twice the size from −2 to 0.
    const FileMesh turned("obj", leaning, R"(, "rotate_z": 90, "scale": 2, "translate": [0, 0, 1])");
    const Surface surface = turned.seen_from({-1, 1, 9}, {0, 0, -1});
    CHECK(is_near(surface.normal, {0, leaning_half.x, leaning_half.z}));
    CHECK(surface.distance == doctest::Approx(8));
    // With y up, the file's z is −y in the scene.
    const FileMesh upright("obj", leaning, R"(, "y_up": true)");
    CHECK(is_near(upright.seen_from({0.5f, -9, 0.5f}, {0, 1, 0}).normal, {leaning_half.x, -leaning_half.z, 0}));
    const FileMesh flat("obj", leaning, R"(, "smooth": false)");
    CHECK(is_near(flat.seen_from({0.5f, 0.5f, 9}, {0, 0, -1}).normal, {0, 0, 1}));
}

TEST_CASE("without normals in the file vertices have the means of their faces', also where each face has its own") {
    // An octahedron. An STL file contains each of its corners four times.
    std::string stl = "solid\n";
    for (const float x : {1.0f, -1.0f})
        for (const float y : {1.0f, -1.0f})
            for (const float z : {1.0f, -1.0f}) {
                const auto corner = [&](float a, float b, float c) {
                    stl += "vertex " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
                };
                stl += "facet\n";
                corner(x, 0, 0);
                corner(0, x * y * z > 0 ? y : 0, x * y * z > 0 ? 0 : z);
                corner(0, x * y * z > 0 ? 0 : y, x * y * z > 0 ? z : 0);
                stl += "endfacet\n";
            }
    const FileMesh smooth("stl", stl + "endsolid\n");
    CHECK(smooth.mesh().vertices.size() == 6);
    CHECK(smooth.mesh().triangles.size() == 8);
    for (std::size_t t = 0; t < 8; ++t)
        for (int i = 0; i < 3; ++i)
            CHECK(is_near(smooth.mesh().normals.at(smooth.mesh().triangles, t, i),
                          smooth.mesh().vertices[smooth.mesh().triangles[t][i]]));
    const FileMesh flat("stl", stl + "endsolid\n", R"(, "smooth": false)");
    CHECK(is_near(flat.seen_from({9.2f, 9.2f, 9.1f}, {-1, -1, -1}).normal, glm::vec3(1 / std::sqrt(3.0f))));
    CHECK_FALSE(is_near(smooth.seen_from({9.2f, 9.2f, 9.1f}, {-1, -1, -1}).normal, glm::vec3(1 / std::sqrt(3.0f))));
}

TEST_CASE("corners of STL files that differ by rounding have one normal") {
    // A bent sheet: four triangles around its middle, two of which have the middle at a slightly different position.
    const auto sheet = [](const std::string& other_middle) {
        const std::string corners[] = {"1 1 0", "-1 1 0", "-1 -1 0", "1 -1 0"};
        std::string stl = "solid\n";
        for (std::size_t i = 0; i < 4; ++i)
            stl += "facet vertex " + corners[i] + " vertex " + corners[(i + 1) % 4] + " vertex " +
                   (i % 2 == 1 ? other_middle : "0 0 0.5") + " endfacet\n";
        return stl + "endsolid\n";
    };
    const FileMesh exact("stl", sheet("0 0 0.5"));
    CHECK(exact.mesh().vertices.size() == 5);
    for (const std::string near : {"1e-20 0 0.5", "-1e-9 1e-9 0.5", "0 0 0.50000006"}) {
        const FileMesh rounded("stl", sheet(near));
        CHECK(rounded.mesh().vertices.size() == 5);
        CHECK(is_near(rounded.seen_from({0, 0, 9}, {0, 0, -1}).normal, {0, 0, 1}));
    }
    const FileMesh apart("stl", sheet("0 0 0.500001"));
    CHECK(apart.mesh().vertices.size() == 6);
}

TEST_CASE("a file of another kind, or of none, is rejected with a hint") {
    const auto said = [](const std::string& kind, const std::string& file) {
        try {
            (void)scene_of(R"("a": {"diffuse": {"color": [1, 1, 1]}})", far_away,
                           R"("meshes": [{")" + kind + R"(": {"file": ")" + file +
                               R"(", "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
        } catch (const phasetree::SceneError& e) {
            return std::string(e.message());
        }
        return std::string();
    };
    CHECK(said("obj", "scan.PLY") == "the name of the file must end in .obj; for scan.PLY use the mesh \"ply\"");
    CHECK(said("ply", "scan.txt") == "the name of the file must end in .ply");
    CHECK(said("obj", "room.gltf") == "the name of the file must end in .obj; for room.gltf use the mesh \"gltf\"");
    CHECK(said("gltf", "room.obj") ==
          "the name of the file must end in .gltf or .glb; for room.obj use the mesh \"obj\"");
    CHECK(said("stl", "none.stl") == "no such file none.stl");
}

}  // namespace test_file_meshes
