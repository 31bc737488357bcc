// Meshes on which clear objects stand, without a gap or an overlap.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "support/uniform.hpp"
#include "tracer/support/paths.hpp"

namespace test_flush_meshes {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A slab of glass between z and z + height over a floor at `floor`, by itself or among objects.
Scene slab_over_floor(double z, double height, double floor, const std::string& in) {
    const std::string slab = fmt::format(
        R"({{"set": {{"phase": "glass", "of": {{"translate": {{"by": [0, 0, {}], "of": {{"box": {{"size": [2, 2, {}]}}}}}}}}}}}})",
        z + height / 2, height);
    return read_scene(phasetree::Document::from_text(
        R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}}, )" + fmt::format(fmt::runtime(in), slab) +
            fmt::format(
                R"(, "meshes": [{{"floor": {{"height": {}, "material": {{"diffuse": {{"color": [1, 1, 1]}}}}}}}}])",
                floor) +
            R"(, "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}})",
        "test.json"));
}

// How many of 200 downward rays that start in the slab meet the floor first, for both kinds of query.
int meet_floor(const Scene& scene, double z, double height) {
    const World world(scene);
    phasetree::tests::Uniform random(7);
    const auto between = [&](float low, float high) { return low + (high - low) * random(); };
    PathCounters counters;
    int met = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 origin(between(-0.3f, 0.3f), between(-0.3f, 0.3f),
                               static_cast<float>(z + height * static_cast<double>(between(0.2f, 0.8f))));
        const glm::vec3 direction =
            glm::normalize(glm::vec3(between(-0.6f, 0.6f), between(-0.6f, 0.6f), static_cast<float>(-height)));
        const auto inside = world.geometry().inside(origin);
        REQUIRE(inside.phase.index == 1);
        const Ray ray{origin, direction, inside.phase, {}, inside.in};
        const Hit hit = world.geometry().intersect(ray, counters);
        const auto* surface = std::get_if<Surface>(&hit);
        const Visibility seen = world.geometry().visibility(ray, 1000.0f, counters);
        REQUIRE(surface != nullptr);
        CHECK(std::holds_alternative<Blocked>(seen) == !surface->far_side);
        met += surface->far_side ? 0 : 1;
    }
    return met;
}

}  // namespace

TEST_CASE("a clear object that stands flush on a mesh touches it, and one a little above does not") {
    for (const char* const in :
         {R"("tree": {})", R"("objects": [{{"name": "a", "tree": {}}}])",
          R"("objects": [{{"name": "a", "tree": {}, "transform": [{{"rotate": {{"angle": 33}}}}]}}])"}) {
        CAPTURE(in);
        for (const double z : {0.0, 0.1, -2.7, 13.3})
            for (const double height : {0.5, 1.0 / 3}) {
                CAPTURE(z);
                CAPTURE(height);
                for (const double into : {0.0, 1e-6, 2e-5})
                    CHECK(meet_floor(slab_over_floor(z, height, z + into, in), z, height) == 200);
                CHECK(meet_floor(slab_over_floor(z, height, z - 1e-4, in), z, height) == 0);
            }
    }
}

}  // namespace test_flush_meshes
