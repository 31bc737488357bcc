// Normal maps on meshes, and the tangents that they need.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "scene/mesh_tangents.hpp"
#include "tracer/support/paths.hpp"

namespace test_normal_maps {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

constexpr double pi = 3.14159265358979323846;

const std::string far_away =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0, 0, -99], "of": {"sphere": {"radius": 1}}}}}})";

// A mesh whose map has the same normal everywhere, leaning to the right and to the top of the image.
class MappedMesh {
  public:
    static glm::vec3 mapped() { return glm::normalize(glm::vec3(0.4f, 0.2f, 0.8f)); }

    explicit MappedMesh(const std::string& obj, const std::string& map = "", const std::string& more = "") {
        phasetree::support::write_text(folder_ / "a.obj", obj);
        const std::string image = (folder_ / "a.tif").string();
        const auto out = OIIO::ImageOutput::create(image);
        REQUIRE(out);
        REQUIRE(out->open(image, OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::FLOAT)));
        const glm::vec3 stored = 0.5f * (mapped() + 1.0f);
        REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, &stored));
        out->close();
        scene_ = scene_of(R"("a": {"diffuse": {"color": [1, 1, 1]}})", far_away,
                          std::string(white_environment) + R"(, "meshes": [{"obj": {"file": ")" +
                              (folder_ / "a.obj").string() + "\"" + more +
                              R"(, "material": {"diffuse": {"color": [1, 1, 1], "normal_map": {"file": ")" + image +
                              "\"" + map + "}}}}}]");
    }
    const Mesh& mesh() const { return scene_.meshes.at(0); }
    Surface seen_from(const glm::vec3& origin, const glm::vec3& direction) const {
        const auto surface = surface_met(World(scene_), origin, direction);
        REQUIRE(surface);
        return *surface;
    }
    glm::vec3 from_above() const { return seen_from({0.4f, 0.3f, 9}, {0, 0, -1}).normal; }

  private:
    phasetree::support::TemporaryDirectory folder_;
    Scene scene_;
};

bool is_near(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 2e-4f;
}

// A square whose image is upright, rotated by a quarter turn, or mirrored.
const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string upright = square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
const std::string turned = square + "vt 0 0\nvt 0 -2\nvt 3 -2\nvt 3 0\nf 1/1 2/2 3/3 4/4\n";
const std::string mirrored = square + "vt 0 0\nvt -1 0\nvt -1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

}  // namespace

TEST_CASE("a map of normals leans to the right of the image and to its upper edge") {
    const glm::vec3 m = MappedMesh::mapped();
    CHECK(is_near(MappedMesh(upright).from_above(), m));
    CHECK_FALSE(is_near(MappedMesh(upright).from_above(), glm::normalize(m + glm::vec3(0.01f, 0, 0))));
    // The image's right side is at the square's upper edge, and its upper edge at the left.
    CHECK(is_near(MappedMesh(turned).from_above(), {-m.y, m.x, m.z}));
    CHECK(is_near(MappedMesh(mirrored).from_above(), {-m.x, m.y, m.z}));
    CHECK(is_near(MappedMesh(upright, R"(, "repeat": [-2, 3])").from_above(), {-m.x, m.y, m.z}));
    CHECK(is_near(MappedMesh(upright, R"(, "repeat": [2, -3])").from_above(), {m.x, -m.y, m.z}));
    CHECK(is_near(MappedMesh(upright, R"(, "green_down": true)").from_above(), {m.x, -m.y, m.z}));
    CHECK(is_near(MappedMesh(upright, R"(, "strength": 0.5)").from_above(),
                  glm::normalize(glm::vec3(0.5f * m.x, 0.5f * m.y, m.z))));
    CHECK(is_near(MappedMesh(upright, R"(, "strength": 0)").from_above(), {0, 0, 1}));
    // From behind, it is the other side of the same relief.
    const Surface behind = MappedMesh(upright).seen_from({0.4f, 0.3f, -9}, {0, 0, 1});
    CHECK(is_near(behind.normal, -m));
    CHECK(is_near(behind.geometric_normal, {0, 0, -1}));
    // Faces without normals in a mesh with some normals are oriented by the order of their corners.
    const std::string partly =
        square + "v 5 5 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nf 2/1/1 5/2/1 3/3/1\n";
    CHECK(is_near(MappedMesh(partly).seen_from({0.4f, 0.3f, -9}, {0, 0, 1}).normal, -m));
    // The normal rotates with the mesh; a flat mesh is oriented by the order of its corners alone.
    const MappedMesh placed(upright, "", R"(, "rotate_z": 90, "smooth": false)");
    CHECK(is_near(placed.seen_from({-0.4f, 0.3f, 9}, {0, 0, -1}).normal, {-m.y, m.x, m.z}));
}

TEST_CASE("on a smooth mesh the frame is that of the shading normal, the same on both sides of each edge") {
    // A cylinder about z with few sides. u goes around it, v goes up.
    constexpr int sides = 12;
    std::string obj;
    for (int i = 0; i <= sides; ++i) {
        const double a = 2 * pi * i / sides;
        for (const int z : {0, 1}) {
            obj +=
                "v " + std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + " " + std::to_string(z) + "\n";
            obj += "vn " + std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + " 0\n";
            obj += "vt " + std::to_string(i / double(sides)) + " " + std::to_string(z) + "\n";
        }
    }
    for (int i = 0; i < sides; ++i) {
        obj += "f";
        for (const int corner : {2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2}) {
            const std::string n = std::to_string(corner);
            obj += " " + n + "/" + n + "/" + n;
        }
        obj += "\n";
    }
    const MappedMesh cylinder(obj);
    const glm::vec3 m = MappedMesh::mapped();
    for (int i = 0; i < 200; ++i) {
        const double a = 2 * pi * (i + 0.3) / 200;
        const glm::vec3 out(std::cos(a), std::sin(a), 0), around(-std::sin(a), std::cos(a), 0);
        const Surface surface = cylinder.seen_from(3.0f * out + glm::vec3(0, 0, 0.4f), -out);
        // The interpolated normal differs from the cylinder's by at most a few thousandths.
        CHECK(glm::length(surface.normal - (m.x * around + m.y * glm::vec3(0, 0, 1) + m.z * out)) < 0.01f);
    }
    // The tangents of the seam's corners are those of one side alone.
    const Mesh& mesh = cylinder.mesh();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const glm::vec4 tangent = mesh.tangents.at(mesh.triangles, t, i);
            const glm::vec3 n = mesh.normals.at(mesh.triangles, t, i);
            CHECK(tangent.w == 1);
            CHECK(std::abs(glm::dot(glm::vec3(tangent), n)) < 1e-5f);
            CHECK(glm::length(glm::vec3(tangent) - glm::vec3(-n.y, n.x, 0)) < 0.3f);
        }
}

TEST_CASE("a map of normals is rejected where there are no coordinates, and beside a bump") {
    const auto said = [](const auto& make) {
        try {
            make();
        } catch (const phasetree::SceneError& e) {
            return std::string(e.message());
        }
        return std::string();
    };
    CHECK(said([] {
              MappedMesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
          }).find("a \"normal_map\" needs texture coordinates") == 0);
    CHECK(said([] { MappedMesh(upright, R"(}, "bump_height": 1, "bump": {"wood": {})"); }).find("cannot be combined") !=
          std::string::npos);
    CHECK(said([] { MappedMesh(upright, R"(, "strength": -1)"); }).find("strength") != std::string::npos);
}

}  // namespace test_normal_maps
