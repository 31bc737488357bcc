// Impossible resolutions, and trees far from the origin: rays end and hit what is there, and the geometry reports the
// resolution that it uses instead of the requested one.
#include <fmt/format.h>

#include "embree/api/api.hpp"

namespace test_resolution {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

embree::Tree ball(float x) {
    return embree::Tree::from_text(fmt::format(
        R"({{"phases": {{"a": 0}}, "tree": {{"set": {{"phase": "a", "of": {{"translate": {{"by": [{}, 0, 0], "of": {{"sphere": {{"radius": 1}}}}}}}}}}}}}})",
        x));
}

PhasetreeGeometryOptions resolving(float resolution) {
    PhasetreeGeometryOptions options = embree::default_options();
    options.resolution = resolution;
    return options;
}

}  // namespace

TEST_CASE("rays end at any resolution that is accepted, and hit what is there") {
    for (const float x : {0.0f, 1e3f, 1e5f, 1e6f}) {
        for (const float wanted : {0.0f, 1e-45f, 1e-20f, 1e-9f, 1e-4f, 1.0f, 1e10f}) {
            CAPTURE(x);
            CAPTURE(wanted);
            const Placed placed(ball(x), resolving(wanted));
            const float resolution = placed.geometry.statistics().resolution;
            CHECK(resolution >= 2.5e-7f * x);
            CHECK(resolution <= std::max(0.035f, 3e-7f * x));
            const bool is_as_wanted = wanted == 0 || resolution == wanted;
            CHECK(placed.geometry.warning().empty() == (is_as_wanted && x < 2e3f));
            for (const glm::vec3 axis : {glm::vec3(0, 0, -1), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)}) {
                const Ray ray{glm::vec3(x, 0, 0) + 0.1f * glm::vec3(axis.y, axis.z, axis.x) - 5.0f * axis, axis};
                const RTCRayHit first = trace_one(placed.scene, rayhit(ray));
                REQUIRE(hits(first));
                const float slack = 4 * resolution + 4e-7f * x;
                CHECK(std::abs(first.ray.tfar - (5 - std::sqrt(0.99f))) < slack);
                // On to the other side, and out.
                const RTCRayHit second = trace_one(placed.scene, rayhit(ray, first.ray.tfar + 2 * resolution));
                REQUIRE(hits(second));
                CHECK(std::abs(second.ray.tfar - (5 + std::sqrt(0.99f))) < slack);
                CHECK(occluded_one(placed.scene, rayhit(ray)));
            }
        }
    }
}

TEST_CASE("what leaves too few digits is warned of, and what leaves none is rejected") {
    const Placed near(ball(0)), far(ball(1e5f));
    CHECK(near.geometry.warning() == "");
    CHECK(far.geometry.warning().find("move it closer to the origin") != std::string::npos);
    CHECK(Placed(ball(0), resolving(1e-20f)).geometry.warning().find("finer than 32-bit") != std::string::npos);
    CHECK(Placed(ball(0), resolving(1e10f)).geometry.warning().find("too coarse") != std::string::npos);
    Device device;
    PhasetreeGeometry geometry = nullptr;
    CHECK(phasetreeNewGeometry(PHASETREE_API_VERSION, device, ball(1e8f).get(), nullptr, &geometry) ==
          PHASETREE_ERROR_INVALID_TREE);
    CHECK(std::string(phasetreeGetErrorMessage()).find("move it to the origin") != std::string::npos);
    CHECK(geometry == nullptr);
    // A geometry's warning is that of its tree.
    embree::Geometry edited(device, ball(1e5f));
    CHECK(!edited.warning().empty());
    edited.set_tree(ball(0));
    CHECK(edited.warning().empty());
}

}  // namespace test_resolution
