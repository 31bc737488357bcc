// Edits of a geometry that is in a scene: other trees, other phases to show, refit and rebuilt, and back.
#include "embree/api/api.hpp"

namespace test_edits {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

embree::Tree ball(float radius) {
    return embree::Tree::from_text(
        R"({"phases": {"a": 0, "b": 0}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": )" +
        std::to_string(radius) + "}}}}}");
}

float distance_to(RTCScene scene, const Ray& ray) {
    const RTCRayHit r = trace_one(scene, rayhit(ray));
    return hits(r) ? r.ray.tfar : infinity;
}

}  // namespace

TEST_CASE("another tree: after a commit it is what rays hit, by refitting as by rebuilding") {
    const Ray ray{{-9, 0, 0}, {1, 0, 0}};
    for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_REFIT}) {
        for (const int flags : {0, static_cast<int>(RTC_SCENE_FLAG_DYNAMIC)}) {
            CAPTURE(quality);
            CAPTURE(flags);
            Device device;
            embree::Geometry geometry(device, ball(1));
            const RTCScene scene = new_scene(device, flags);
            rtcSetGeometryBuildQuality(geometry.embree(), quality);
            rtcCommitGeometry(geometry.embree());
            rtcAttachGeometry(scene, geometry.embree());
            rtcCommitScene(scene);
            CHECK(distance_to(scene, ray) == doctest::Approx(8));
            for (const float radius : {2.0f, 0.5f, 3.0f, 1.0f}) {
                geometry.set_tree(ball(radius));
                rtcCommitGeometry(geometry.embree());
                rtcCommitScene(scene);
                CHECK(distance_to(scene, ray) == doctest::Approx(9 - radius));
                RTCBounds b;
                rtcGetSceneBounds(scene, &b);
                CHECK(b.upper_x == doctest::Approx(radius).epsilon(0.01));
            }
            rtcReleaseScene(scene);
        }
    }
}

TEST_CASE("a failed edit leaves the geometry as it was") {
    Placed placed(ball(1));
    const Ray ray{{-9, 0, 0}, {1, 0, 0}};
    PhasetreeGeometryOptions options = embree::default_options();
    options.resolution = -1;
    CHECK_THROWS_AS(placed.geometry.set_tree(ball(2), options), embree::Error);
    options = embree::default_options();
    options.cancelled = [](void*) { return true; };
    try {
        placed.geometry.set_tree(object_tree(), options);
        FAIL("not cancelled");
    } catch (const embree::Error& e) {
        CHECK(e.code() == PHASETREE_ERROR_CANCELLED);
    }
    const embree::Tree unbounded = embree::Tree::from_text(
        R"({"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of": {"plane": {"normal": [0, 0, 1]}}}}})");
    CHECK_THROWS_AS(placed.geometry.set_tree(unbounded), embree::Error);
    CHECK(distance_to(placed.scene, ray) == doctest::Approx(8));
}

TEST_CASE("phases to show change at once") {
    Placed placed;
    const Ray ray{{0.01f, 0.02f, 3}, {0, 0, -1}};
    const RTCRayHit all = trace_one(placed.scene, rayhit(ray));
    REQUIRE(hits(all));
    placed.geometry.set_shown_phases(1u << 4);
    const RTCRayHit sand = trace_one(placed.scene, rayhit(ray));
    REQUIRE(hits(sand));
    CHECK((sand.hit.u == 4 || sand.hit.v == 4));
    CHECK(sand.ray.tfar > all.ray.tfar);
    placed.geometry.set_shown_phases(0);
    CHECK_FALSE(hits(trace_one(placed.scene, rayhit(ray))));
    placed.geometry.set_shown_phases(PHASETREE_ALL_PHASES);
    CHECK(same_bits(trace_one(placed.scene, rayhit(ray)), all));
}

TEST_CASE("options of cells and resolution") {
    const embree::Tree tree = object_tree();
    PhasetreeGeometryOptions coarse = embree::default_options();
    coarse.cellDivisions = 1;
    const Placed fine(tree), few(tree, coarse);
    CHECK(few.geometry.statistics().cells < fine.geometry.statistics().cells);
    CHECK(few.geometry.statistics().maxInstructions >= fine.geometry.statistics().maxInstructions);
    const auto of_quality = [](RTCBuildQuality quality) {
        PhasetreeGeometryOptions options = embree::default_options();
        options.buildQuality = quality;
        return options;
    };
    const Placed low(tree, of_quality(RTC_BUILD_QUALITY_LOW)), high(tree, of_quality(RTC_BUILD_QUALITY_HIGH));
    CHECK(low.geometry.statistics().cells != fine.geometry.statistics().cells);
    CHECK(high.geometry.statistics().cells == fine.geometry.statistics().cells);
    PhasetreeGeometryOptions rough = embree::default_options();
    rough.resolution = 1e-3f;
    const Placed blurred(tree, rough);
    CHECK(blurred.geometry.statistics().resolution == 1e-3f);
    for (const Ray& ray : rays(500, 91)) {
        const RTCRayHit a = trace_one(fine.scene, rayhit(ray)), b = trace_one(few.scene, rayhit(ray)),
                        c = trace_one(blurred.scene, rayhit(ray));
        REQUIRE(hits(a) == hits(b));
        if (hits(a)) REQUIRE(same_place(a.ray.tfar, b.ray.tfar, fine.geometry.statistics().resolution));
        for (const Placed* const other : {&low, &high}) {
            const RTCRayHit found = trace_one(other->scene, rayhit(ray));
            REQUIRE(hits(a) == hits(found));
            if (hits(a)) REQUIRE(same_place(a.ray.tfar, found.ray.tfar, fine.geometry.statistics().resolution));
        }
        if (hits(a) && hits(c) && a.hit.v == c.hit.v && a.hit.u == c.hit.u &&
            std::abs(a.hit.Ng_x * ray.direction.x + a.hit.Ng_y * ray.direction.y + a.hit.Ng_z * ray.direction.z) > 0.2f)
            REQUIRE(std::abs(a.ray.tfar - c.ray.tfar) < 0.02f);
    }
}

}  // namespace test_edits
