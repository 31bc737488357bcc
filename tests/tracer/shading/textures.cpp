// Textures in scene files: controlled by fields of the tree, and from images, on phases and on meshes.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "phasetree_support/temporary_directory.hpp"
#include "shading/texture/ramp.hpp"
#include "tracer/support/paths.hpp"

namespace test_textures {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string water_over_sand = R"({"under": [{"set": {"phase": "sand", "of": {"box": {"size": [2, 2, 2]}}}},
    {"set": {"phase": "water", "of": {"translate": {"by": [3, 0, 0], "of": {"sphere": {"radius": 1}}}}}}]})";

Scene sand_of(const std::string& material, const std::string& more = "") {
    return scene_of(R"("water": {"clear": {"ior": 1.33}}, "sand": )" + material, water_over_sand,
                    white_environment + more);
}

std::string message_of(const std::string& material, const std::string& more = "") {
    try {
        (void)sand_of(material, more);
    } catch (const phasetree::SceneError& e) {
        return e.what();
    }
    return "";
}

bool says(const std::string& material, const std::string& part, const std::string& more = "") {
    const std::string message = message_of(material, more);
    CAPTURE(message);
    return message.find(part) != std::string::npos;
}

const std::string ball_of_water = R"({"translate": {"by": [3, 0, 0], "of": {"sphere": {"radius": 1}}}})";

// Two by two pixels: red and green above blue and grey (sRGB 0.5).
std::filesystem::path four_pixels() {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "phasetree_test_four_pixels.png";
    const unsigned char pixels[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128};
    const auto out = OIIO::ImageOutput::create(path.string());
    REQUIRE(out);
    REQUIRE(out->open(path.string(), OIIO::ImageSpec(2, 2, 3, OIIO::TypeDesc::UINT8)));
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels));
    out->close();
    return path;
}

}  // namespace

TEST_CASE("where a ramp jumps it has the later value") {
    struct Stop {
        float at;
    };
    const std::vector<Stop> stops{{0}, {1}, {1}, {3}};
    const auto between = [&](float value) { return between_stops(std::span<const Stop>(stops), value); };
    CHECK(between(-1).above == 0);
    CHECK(between(0.5f).below == 0);
    CHECK(between(0.5f).part == 0.5f);
    CHECK(between(1).below == 2);
    CHECK(between(1).part == 0);
    CHECK(between(2).part == 0.5f);
    CHECK(between(3).below == 3);
    CHECK(between(4).above == 3);
}

TEST_CASE("textures by the tree: colours follow the distance to another phase, along a ramp") {
    const Scene scene = sand_of(R"({"diffuse": {"color": {"field": {"of": )" + ball_of_water +
                                R"(, "ramp": [[0, [0, 0, 0]], [1, [0.5, 0.25, 0]], [2, {"checker": {"even": [1, 1, 1],
        "odd": [1, 1, 1]}}]]}}}})");
    const Texture& color = std::get<Diffuse>(scene.materials[2]).color;
    // At distance 1 + d from the ball's middle.
    const auto at = [&](float d) { return color_at(color, glm::vec3(3 - 1 - d, 0, 0)); };
    CHECK(glm::length(at(-0.5f)) == 0.0f);
    CHECK(glm::length(at(0.5f) - glm::vec3(0.25f, 0.125f, 0)) < 1e-6f);
    CHECK(glm::length(at(1.5f) - glm::vec3(0.75f, 0.625f, 0.5f)) < 1e-6f);
    CHECK(at(7) == glm::vec3(1));
    CHECK_FALSE(glm::length(at(0.505f) - glm::vec3(0.25f, 0.125f, 0)) < 1e-3f);
}

TEST_CASE("textures by the tree: roughness and films, and what is wrong with a ramp") {
    const auto ramp = [](const std::string& stops) {
        return R"({"conductor": {"metal": "gold", "roughness": {"field": {"of": {"sphere": {"radius": 1}}, "ramp": )" +
               stops + "}}}}";
    };
    const Scene scene = sand_of(ramp("[[0, 0.1], [2, 0.5]]"));
    const Number& roughness = std::get<Conductor>(scene.materials[2]).roughness;
    CHECK(number_at(roughness, glm::vec3(2, 0, 0)) == doctest::Approx(0.3));
    CHECK(number_at(roughness, glm::vec3(9, 0, 0)) == 0.5f);
    CHECK(least_of(roughness) == 0.1f);
    CHECK(greatest_of(roughness) == 0.5f);
    CHECK(says(ramp("[[0, 0.1], [2, 1.5]]"), "1.5"));
    CHECK(says(ramp("[[2, 0.1], [0, 0.5]]"), "must increase, but 0 follows 2"));
    CHECK(says(ramp("[]"), "must be a list of stops"));
    CHECK(says(ramp("[[1]]"), "must be [value of the field, result]"));
    CHECK(says(R"({"diffuse": {"color": {"field": {"of": "pond", "ramp": [[0, [1, 1, 1]]]}}}})",
               "unknown shape \"pond\""));
    const Scene film = sand_of(R"({"clear": {"ior": 1.5, "film_thickness": {"field": {"of": {"plane": {}},
        "ramp": [[0, 100], [1, 900]]}}, "film_ior": 1.4}})");
    CHECK(number_at(std::get<Clear>(film.materials[2]).film->thickness, glm::vec3(0, 0, 0.5f)) == doctest::Approx(500));
}

TEST_CASE("each copy of an object has its own colour and roughness, the same all over it") {
    std::string places;
    for (int i = 0; i < 30; ++i) places += (i > 0 ? ", [" : "[") + std::to_string(3 * i) + ", 0, 0]";
    const Scene scene = read_scene(phasetree::Document::from_text(
        R"({"version": 1, "phases": {"sweet": {"coated": {"color": {"per_copy": {"ramp": [[0, [1, 0, 0]], [0.5, [1, 0, 0]],
            [0.5, [0, 0, 1]], [1, [0, 0, 1]]]}}, "roughness": {"per_copy": {"ramp": [[0, 0.2], [1, 0.4]], "seed": 1}}}}},
            "objects": [{"name": "ball", "tree": {"set": {"phase": "sweet", "of": {"sphere": {"radius": 1}}}}}],
            "instances": [{"of": "ball", "transforms": [)" +
            places + R"(]}], "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}})",
        "test.json"));
    const World world(scene);
    const auto& sweet = std::get<Coated>(scene.materials[1]);
    PathCounters counters;
    int red = 0;
    std::set<float> roughnesses;
    for (int i = 0; i < 30; ++i) {
        std::optional<glm::vec3> color;
        for (const float to : {-0.7f, 0.1f, 0.6f}) {
            const Ray ray{{3.0f * static_cast<float>(i) + to, -5, to}, {0, 1, 0}, phasetree::vacuum, {}};
            const Hit hit = world.geometry().intersect(ray, counters);
            REQUIRE(std::holds_alternative<Surface>(hit));
            const TexturePoint& place = std::get<Surface>(hit).place;
            const glm::vec3 here = color_at(sweet.color, place);
            CHECK(here == color.value_or(here));
            color = here;
            roughnesses.insert(number_at(sweet.roughness, place));
        }
        CHECK((*color == glm::vec3(1, 0, 0) || *color == glm::vec3(0, 0, 1)));
        red += *color == glm::vec3(1, 0, 0) ? 1 : 0;
    }
    CHECK(red > 6);
    CHECK(red < 24);
    CHECK(roughnesses.size() == 30);
    CHECK(*roughnesses.begin() >= 0.2f);
    CHECK(*roughnesses.rbegin() <= 0.4f);
    CHECK(least_of(sweet.roughness) == 0.2f);
    CHECK(greatest_of(sweet.roughness) == 0.4f);
}

TEST_CASE("textures from images: sRGB is decoded, and each side of a solid gets its own projection") {
    const std::filesystem::path path = four_pixels();
    const Scene scene =
        sand_of(R"({"diffuse": {"color": {"image": {"file": ")" + path.string() + R"(", "size": 2, "blend": 0}}}})");
    const Texture& color = std::get<Diffuse>(scene.materials[2]).color;
    const auto at = [&](const glm::vec3& p, const glm::vec3& n) { return color_at(color, {p, n, std::nullopt}); };
    // Middles of the pixels: the lower left one is blue.
    CHECK(glm::length(at({0.5f, 0.5f, 9}, {0, 0, 1}) - glm::vec3(0, 0, 1)) < 1e-4f);
    CHECK(glm::length(at({0.5f, 1.5f, 9}, {0, 0, -1}) - glm::vec3(1, 0, 0)) < 1e-4f);
    CHECK(glm::length(at({2.5f, 9, 1.5f}, {0, 1, 0}) - glm::vec3(1, 0, 0)) < 1e-4f);
    CHECK(glm::length(at({9, 1.5f, 1.5f}, {1, 0, 0}) - glm::vec3(0, 1, 0)) < 1e-4f);
    CHECK(at({1.5f, 0.5f, 9}, {0, 0, 1}).x == doctest::Approx(0.2158605f).epsilon(1e-4));  // of 128/255
    CHECK_FALSE(at({1.5f, 0.5f, 9}, {0, 0, 1}).x == doctest::Approx(1.01f * 0.2158605f).epsilon(1e-4));
    CHECK(says(R"({"diffuse": {"color": {"image": {"file": "no_such_file.png"}}}})", "no such file"));
    CHECK(says(R"({"diffuse": {"color": {"mesh_image": {"file": ")" + path.string() + R"("}}}})", "only on meshes"));
    std::filesystem::remove(path);
}

TEST_CASE("textures from images: on a mesh by its coordinates, and an error where it has none") {
    const std::filesystem::path path = four_pixels();
    const std::filesystem::path obj = std::filesystem::temp_directory_path() / "phasetree_test_uv.obj";
    const auto mesh_of = [&](const std::string& faces) {
        std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n" << faces;
        return std::string(R"(, "meshes": [{"obj": {"file": ")") + obj.string() +
               R"(", "material": {"diffuse": {"color": {"mesh_image": {"file": ")" + path.string() + R"("}}}}}}])";
    };
    const Scene scene = sand_of(R"({"diffuse": {"color": [1, 1, 1]}})", mesh_of("f 1/1 2/2 3/3 4/4\n"));
    const Mesh& mesh = scene.meshes.at(0);
    REQUIRE(mesh.uv.triangles.size() == 2);
    REQUIRE(mesh.triangles.size() == 2);
    for (std::size_t t = 0; t < 2; ++t)
        for (int k = 0; k < 3; ++k)
            CHECK(mesh.uv.at(mesh.triangles, t, k) == glm::vec2(mesh.vertices[mesh.triangles[t][k]]));
    const Texture& color = std::get<Diffuse>(mesh.material).color;
    CHECK(glm::length(color_at(color, {{}, {0, 0, 1}, MeshCoordinates{{0.25f, 0.25f}}}) - glm::vec3(0, 0, 1)) < 1e-4f);
    CHECK(says(R"({"diffuse": {"color": [1, 1, 1]}})", "needs texture coordinates", mesh_of("f 1 2 3\n")));
    CHECK(
        says(R"({"diffuse": {"color": [1, 1, 1]}})", "needs texture coordinates", mesh_of("f 1/1 2/2 3/3\nf 1 3 4\n")));
    std::filesystem::remove(path);
    std::filesystem::remove(obj);
}

TEST_CASE("a roughness by an image on a mesh: numbers as they are stored, between black's and white's") {
    const std::filesystem::path path = four_pixels();
    const phasetree::support::TemporaryDirectory folder;
    const auto mesh_of = [&](const std::string& more, const std::string& corners) {
        phasetree::support::write_text(folder / "a.obj",
                                       "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf " + corners + "\n");
        return R"(, "meshes": [{"obj": {"file": ")" + (folder / "a.obj").string() +
               R"(", "material": {"coated": {"color": [1, 1, 1], "roughness": {"mesh_image": {"file": ")" +
               path.string() + "\"" + more + "}}}}}}]";
    };
    const std::string white = R"({"diffuse": {"color": [1, 1, 1]}})";
    const Scene scene = sand_of(white, mesh_of(R"(, "range": [0.5, 0.1])", "1/1 2/2 3/3"));
    const Number& roughness = std::get<Coated>(scene.meshes.at(0).material).roughness;
    const auto at = [&](const glm::vec2& uv) {
        return number_at(roughness, {{}, {0, 0, 1}, MeshCoordinates{.uv = uv}});
    };
    CHECK(at({0.25f, 0.75f}) == doctest::Approx(0.1));
    CHECK(at({0.25f, 0.25f}) == doctest::Approx(0.5));
    CHECK(at({0.75f, 0.25f}) == doctest::Approx(0.5 - 0.4 * 128 / 255));
    CHECK_FALSE(1.01f * at({0.75f, 0.25f}) == doctest::Approx(0.5 - 0.4 * 128 / 255).epsilon(1e-3));
    CHECK(least_of(roughness) == doctest::Approx(0.1));
    CHECK(greatest_of(roughness) == doctest::Approx(0.5));
    CHECK(says(white, "the range has 2", mesh_of(R"(, "range": [0, 2])", "1/1 2/2 3/3")));
    CHECK(says(white, "\"mesh_image\" needs texture coordinates", mesh_of("", "1 2 3")));
    CHECK(says(R"({"coated": {"color": [1, 1, 1], "roughness": {"mesh_image": {"file": ")" + path.string() + R"("}}}})",
               "works only on meshes"));
    std::filesystem::remove(path);
}

TEST_CASE("colours of a mesh's vertices: sRGB is decoded, and between vertices they are interpolated") {
    const phasetree::support::TemporaryDirectory folder;
    const auto mesh_of = [&](const std::string& name, const std::string& content) {
        phasetree::support::write_text(folder / name, content);
        return R"(, "meshes": [{")" + name.substr(name.size() - 3) + R"(": {"file": ")" + (folder / name).string() +
               R"(", "material": {"diffuse": {"color": {"vertex_color": {}}}}}}])";
    };
    const std::string white = R"({"diffuse": {"color": [1, 1, 1]}})";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
        "red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n-4 -4 2 255 0 128\n8 -4 2 0 255 128\n-4 8 2 0 0 128\n3 0 1 2\n";
    const std::string obj = "v -4 -4 2 1 0 0.501961\nv 8 -4 2 0 1 0.501961\nv -4 8 2 0 0 0.501961\nf 1 2 3\n";
    for (const std::string& mesh : {mesh_of("a.ply", ply), mesh_of("a.obj", obj)}) {
        const Scene scene = sand_of(white, mesh);
        const World world(scene);
        PathCounters counters;
        // A quarter of the way to the second vertex, and half of it to the third.
        const Hit hit = world.geometry().intersect(Ray{{-1, 2, 9}, {0, 0, -1}}, counters);
        const Surface* surface = std::get_if<Surface>(&hit);
        REQUIRE(surface);
        const glm::vec3 found = color_at(std::get<Diffuse>(scene.meshes.at(0).material).color, surface->place);
        const glm::vec3 expected(0.25f, 0.25f, 0.2158605f);
        CHECK(glm::length(found - expected) < 1e-4f);
        CHECK_FALSE(glm::length(1.01f * found - expected) < 1e-4f);
        // As bumps evaluate it: one unit to the right, a twelfth of red has become green.
        const TexturePoint moved = surface->place.moved({1, 0, 0});
        const glm::vec3 beside = color_at(std::get<Diffuse>(scene.meshes.at(0).material).color, moved);
        CHECK(glm::length(beside - expected - glm::vec3(-1, 1, 0) / 12.0f) < 1e-4f);
    }
    const std::string partly = "v -4 -4 2 1 0 0.5\nv 8 -4 2 0 1 0.5\nv -4 8 2\nf 1 2 3\n";
    CHECK(says(white, "needs colours, which some vertices", mesh_of("b.obj", partly)));
    CHECK(says(R"({"diffuse": {"color": {"vertex_color": {}}}})", "works only on meshes"));
}

}  // namespace test_textures
