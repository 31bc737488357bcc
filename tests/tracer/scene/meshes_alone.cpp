// Scenes of meshes without an object: there is vacuum everywhere except at the meshes.
#include <doctest/doctest.h>

#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "tracer/support/paths.hpp"

namespace test_meshes_alone {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A room without an object, or with one that is far below its floor.
Scene room(const std::string& object, const std::string& more = "") {
    return read_scene(phasetree::Document::from_text(
        R"({"version": 1, )" + object +
            R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
           "lights": [{"gradient": {"zenith": [1, 2, 3], "horizon": [1, 1, 1], "ground": [0, 0, 0]}},
                      {"sphere": {"centre": [0, 0, 2], "radius": 0.5, "radiance": [9, 8, 7]}}],
           "camera": {"position": [0, -5, 1], "look_at": [0, 0, 1]},
           "render": {"width": 24, "height": 16, "samples": 4})" +
            more + "}",
        "room.json"));
}

constexpr const char* far_below = R"("phases": {"a": {"diffuse": {"color": [1, 1, 1]}}},
    "tree": {"set": {"phase": "a", "of": {"translate": {"by": [0, 0, -9], "of": {"sphere": {"radius": 0.1}}}}}},)";

}  // namespace

TEST_CASE("without an object a picture is the same as with one that nothing sees") {
    const Scene alone = room(""), beside = room(far_below);
    CHECK(alone.phases.size() == 0);
    const Image one = image_of(World(alone), alone), other = image_of(World(beside), beside);
    REQUIRE(one.pixels.size() == 24 * 16);
    CHECK(one.pixels == other.pixels);
    float sum = 0;
    for (const glm::vec3& pixel : one.pixels) sum += pixel.x;
    CHECK(sum > 100);
}

TEST_CASE("meshes alone shine, move with the camera and have photons") {
    const Scene alone = room("", R"(, "background": [0, 0, 0])");
    const World world(alone);
    const auto surface = surface_met(world, {1, 2, 3}, {0, 0, -1});
    REQUIRE(surface);
    CHECK(surface->distance == doctest::Approx(3));
    CHECK(world.geometry().label({0, 0, -0.1f}) == phasetree::vacuum);
    CHECK(object_names(alone).back() == "floor");
    Scene caustics = room("");
    caustics.settings.caustics = true;
    CHECK(image_of(World(caustics), caustics).pixels.size() == 24 * 16);
}

}  // namespace test_meshes_alone
