// Two trees and two instances, overlapping: a phase that a ray carries is one geometry's, in one instance.
#include "embree/api/api.hpp"

namespace test_media {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

embree::Tree ball(const std::string& radius) {
    return embree::Tree::from_text(R"({"phases": {"one": 0, "two": 0}, "tree": {"under": [
        {"set": {"phase": "one", "of": {"sphere": {"radius": )" +
                                   radius + R"(}}}},
        {"set": {"phase": "two", "of": {"sphere": {"radius": 0.2}}}}]}})");
}

constexpr unsigned none = RTC_INVALID_GEOMETRY_ID;

}  // namespace

TEST_CASE("two trees keep their phases apart") {
    Device device;
    const auto options = with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT);
    const embree::Geometry small(device, ball("0.5"), options), large(device, ball("0.8"), options);
    EmbreeScene scene(device);
    const unsigned small_id = scene.add(small.embree()), large_id = scene.add(large.embree());
    scene.commit();
    Carrying carrying{PhasetreeCarriedPhase{small_id, none, none, 0}, PhasetreeCarriedPhase{large_id, none, none, 0}};
    // Each crossing belongs to one of them, and only its phase changes.
    struct Step {
        unsigned geometry, entered;
        float x;
    };
    const Step steps[] = {{large_id, 1, -0.8f}, {small_id, 1, -0.5f}, {0, 0, -0.2f},       {0, 0, -0.2f},
                          {0, 0, 0.2f},         {0, 0, 0.2f},         {small_id, 0, 0.5f}, {large_id, 0, 0.8f}};
    Ray ray{{-2, 0.01f, 0}, {1, 0, 0}};
    int twos = 0;
    std::size_t step = 0;
    for (;; ++step) {
        const RTCRayHit r = trace_one(scene, rayhit(ray), {.context = &carrying.context.context});
        if (!hits(r)) break;
        REQUIRE(step < std::size(steps));
        PhasetreeCarriedPhase& entry = carrying.carried[r.hit.geomID == small_id ? 0 : 1];
        REQUIRE(carrying.state.hit.from == entry.phase);
        CHECK(carrying.state.hit.pointFrom[0] == doctest::Approx(steps[step].x).epsilon(0.002));
        if (steps[step].x != -0.2f && steps[step].x != 0.2f) {
            CHECK(r.hit.geomID == steps[step].geometry);
            CHECK(carrying.state.hit.to == steps[step].entered);
        } else {
            ++twos;  // both cores coincide: either may come first
        }
        entry.phase = carrying.state.hit.to;
        ray.origin = vec(carrying.state.hit.pointTo);
    }
    CHECK(step == std::size(steps));
    CHECK(twos == 4);
    CHECK(carrying.carried[0].phase == 0);
    CHECK(carrying.carried[1].phase == 0);
}

TEST_CASE("two instances of one tree keep their phases apart") {
    Device device;
    const embree::Geometry geometry(device, ball("0.5"), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    EmbreeScene inner(device), outer(device);
    inner.add(geometry.embree());
    inner.commit();
    unsigned id[2];
    for (int i = 0; i < 2; ++i) {
        const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, inner);
        const float matrix[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, i == 0 ? -0.15f : 0.15f, 0, 0};
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
        id[i] = outer.add(instance);
        rtcReleaseGeometry(instance);
    }
    outer.commit();
    // Embree 4 numbers a single instance's primitive 0.
    const unsigned prim = RTC_VERSION_MAJOR >= 4 ? 0 : none;
    Carrying carrying{PhasetreeCarriedPhase{0, id[0], prim, 0}, PhasetreeCarriedPhase{0, id[1], prim, 0}};
    Ray ray{{-2, 0.01f, 0}, {1, 0, 0}};
    std::vector<std::pair<unsigned, unsigned>> found;
    for (;;) {
        const RTCRayHit r = trace_one(outer, rayhit(ray), {.context = &carrying.context.context});
        if (!hits(r)) break;
        const unsigned which = r.hit.instID[0] == id[0] ? 0 : 1;
        REQUIRE(carrying.state.hit.from == carrying.carried[which].phase);
        carrying.carried[which].phase = carrying.state.hit.to;
        found.push_back({which, carrying.state.hit.to});
        ray.origin = vec(carrying.state.hit.pointTo) + glm::vec3(which == 0 ? -0.15f : 0.15f, 0, 0);
        REQUIRE(found.size() < 20);
    }
    // Centres at ∓0.15, radii 0.5 and 0.2.
    const std::vector<std::pair<unsigned, unsigned>> expected = {{0, 1}, {1, 1}, {0, 2}, {1, 2},
                                                                 {0, 1}, {1, 1}, {0, 0}, {1, 0}};
    CHECK(found == expected);
}

TEST_CASE("a stock context: overlapping trees each see the phase at the ray's start") {
    Device device;
    const embree::Geometry small(device, ball("0.5")), large(device, ball("0.8"));
    EmbreeScene scene(device);
    const unsigned small_id = scene.add(small.embree()), large_id = scene.add(large.embree());
    scene.commit();
    const RTCRayHit between = trace_one(scene, rayhit({{0.6f, 0.01f, 0}, {1, 0, 0}}));
    REQUIRE(hits(between));
    CHECK(between.hit.geomID == large_id);
    CHECK(between.hit.u == 1);
    const RTCRayHit inwards = trace_one(scene, rayhit({{0.6f, 0.01f, 0}, {-1, 0, 0}}));
    REQUIRE(hits(inwards));
    CHECK(inwards.hit.geomID == small_id);
    CHECK(inwards.hit.u == 0);
}

}  // namespace test_media
