// The balls around parts of emitters. They must cover the emitters, or shadow rays find these only by chance.
#include "scene/emissive_parts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "sampling/warps.hpp"
#include "support/uniform.hpp"
#include "tracer/support/glowing_scenes.hpp"
#include "tracer/support/paths.hpp"

namespace test_emissive_parts {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::Uniform;

TEST_CASE("at most 128 balls cover everything that glows") {
    for (const char* const shape : {R"({"sphere": {"radius": 0.5}})",
                                    R"({"helix": {"radius": 0.3, "pitch": 0.2, "turns": 3, "wire_radius": 0.01}})"}) {
        CAPTURE(shape);
        const Scene scene = scene_of(glowing(), hot(shape, "[1, 2, 3]"), dark);
        const auto parts = scene.lights.emissive_parts();
        CHECK(parts.size() >= 4);
        CHECK(parts.size() <= 128);
        const World world(scene);
        Uniform random(3);
        PathCounters counters;
        int met = 0;
        for (int i = 0; i < 20'000; ++i) {
            const glm::vec3 from = glm::vec3(1, 2, 3) + 2.0f * square_to_uniform_sphere(random.two());
            const glm::vec3 to = glm::vec3(1, 2, 3) + 0.6f * (2.0f * glm::vec3(random(), random(), random()) - 1.0f);
            const Hit hit =
                world.geometry().intersect({from, glm::normalize(to - from), phasetree::vacuum, {}}, counters);
            const auto* surface = std::get_if<Surface>(&hit);
            if (!surface) continue;
            ++met;
            REQUIRE(std::ranges::any_of(parts, [&](const EmissivePart& part) {
                const BoundingSphere ball = part.bounding_sphere();
                return glm::distance(ball.centre, surface->near_side.origin) <= 1.0001f * ball.radius;
            }));
        }
        CHECK(met > 500);
    }
}

TEST_CASE("each of many copies has one ball, and very many copies have none") {
    const auto scene_with = [](int copies) {
        std::string instances;
        for (int i = 0; i < copies; ++i)
            instances += (i > 0 ? ", " : "") + std::string(R"({"of": "ember", "transform": {"translate": {"by": [)") +
                         std::to_string(i) + ", 0, 1]}}}";
        return read_scene(phasetree::Document::from_text(
            R"({"version": 1, "phases": {"hot": {"glowing": {"radiance": 8}}}, "lights": [],
                "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]},
                "objects": [{"name": "ember", "tree": {"set": {"phase": "hot", "of": {"sphere": {"radius": 0.2}}}}}],
                "instances": [)" +
                instances + "]}",
            "test.json"));
    };
    const std::size_t of_one = scene_with(1).lights.emissive_parts().size();
    CHECK(of_one > 5);
    CHECK(scene_with(10).lights.emissive_parts().size() == 10 * of_one);
    const Scene many = scene_with(9000);
    CHECK(many.lights.emissive_parts().size() == 9000);
    const BoundingSphere last = many.lights.emissive_parts().back().bounding_sphere();
    CHECK(glm::distance(last.centre, glm::vec3(8999, 0, 1)) < 0.01f);
    CHECK(last.radius >= 0.2f);
    CHECK(last.radius < 0.5f);
    CHECK(scene_with(10'001).lights.emissive_parts().empty());
}

TEST_CASE("copies that do not emit light do not count") {
    std::string grass;
    for (int i = 0; i < 20'000; ++i)
        grass += R"({"of": "grass", "transform": {"translate": {"by": [)" + std::to_string(i) + ", 0, 1]}}}, ";
    const Scene scene = read_scene(phasetree::Document::from_text(
        R"({"version": 1, "lights": [], "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]},
            "phases": {"hot": {"glowing": {}}, "green": {"diffuse": {"color": [0, 1, 0]}}},
            "objects": [{"name": "ember", "tree": {"set": {"phase": "hot", "of": {"sphere": {"radius": 0.2}}}}},
                        {"name": "grass", "tree": {"set": {"phase": "green", "of": {"sphere": {"radius": 0.1}}}}}],
            "instances": [)" +
            grass + R"({"of": "ember", "transform": {"translate": {"by": [0, 3, 1]}}}]})",
        "test.json"));
    CHECK(scene.lights.emissive_parts().size() > 5);
}

TEST_CASE("each phase has balls of its own size, and a phase that others replace completely has none") {
    const Scene scene = scene_of(
        R"("lava": {"glowing": {}}, "spark": {"glowing": {"radiance": 5}}, "core": {"glowing": {"radiance": 9}},
           "stone": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
        R"({"over": [
              {"set": {"phase": "lava", "of": {"box": {"size": [10, 10, 0.4]}}}},
              {"set": {"phase": "spark", "of": {"translate": {"by": [2, 1, 3], "of": {"sphere": {"radius": 0.02}}}}}},
              {"set": {"phase": "stone", "of": {"translate": {"by": [-2, 1, 3], "of": {"sphere": {"radius": 1}}}}}},
              {"set": {"phase": "core", "of": {"translate": {"by": [-2, 1, 3], "of": {"sphere": {"radius": 0.3}}}}}}]})",
        dark);
    int lava = 0, spark = 0, core = 0;
    for (const EmissivePart& part : scene.lights.emissive_parts()) {
        const BoundingSphere ball = part.bounding_sphere();
        ++(part.luminance() < 3 ? lava : part.luminance() < 7 ? spark : core);
        if (part.luminance() > 3) CHECK(glm::distance(ball.centre, glm::vec3(2, 1, 3)) + ball.radius < 0.1f);
    }
    CHECK(lava >= 4);
    CHECK(spark >= 4);
    CHECK(core == 0);
}

TEST_CASE("a mesh of two triangles is subdivided, and degenerate triangles are harmless") {
    const Scene scene = scene_of(R"("glass": {"clear": {"ior": 1.5}})",
                                 R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})",
                                 R"("meshes": [{"floor": {"size": 40, "material": {"glowing": {}}}}], )" + dark);
    CHECK(scene.lights.emissive_parts().size() == 16);
    Uniform random(5);
    // The box of a triangle whose longest edge is 20 m has sides of 20 m and 10 m.
    for (const EmissivePart& part : scene.lights.emissive_parts()) CHECK(part.bounding_sphere().radius < 11.2f);
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 p(40 * random() - 20, 40 * random() - 20, 0);
        REQUIRE(std::ranges::any_of(scene.lights.emissive_parts(), [&](const EmissivePart& part) {
            return glm::distance(part.bounding_sphere().centre, p) <= 1.0001f * part.bounding_sphere().radius;
        }));
    }
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 2}, {3, 3, 3}, {3, 3, 3}};
    mesh.material = Glowing{};
    const std::vector<EmissiveBall> parts = parts_of_mesh(mesh);
    CHECK(parts.size() == 16);
    for (const EmissiveBall& part : parts) CHECK(part.ball.radius < 0.6f);
    mesh.triangles = {{3, 3, 3}, {3, 3, 3}};
    CHECK(parts_of_mesh(mesh).size() <= 2);
    mesh.triangles.clear();
    CHECK(parts_of_mesh(mesh).empty());
}

TEST_CASE("huge and strong flames have balls with finite numbers") {
    for (const char* const shape : {R"({"shell": {"half_thickness": 1e9, "of": {"sphere": {"radius": 1e13}}}})",
                                    R"({"sphere": {"radius": 1e13}})", R"({"sphere": {"radius": 100}})"}) {
        CAPTURE(shape);
        const Scene scene =
            scene_of(R"("flame": {"clear": {"ior": 1, "emission": [1e38, 1, 1], "absorption": [1, 1, 1]}})",
                     std::string(R"({"set": {"phase": "flame", "of": )") + shape + "}}", dark);
        CHECK(!scene.lights.emissive_parts().empty());
        for (const EmissivePart& part : scene.lights.emissive_parts()) {
            CHECK(std::isfinite(part.luminance()));
            CHECK(part.luminance() > 0);
        }
    }
}

}  // namespace test_emissive_parts
