// Phases, distances and the closest interface at points, and Embree's point queries.
#include "embree/api/api.hpp"

namespace test_points {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

std::vector<glm::vec3> points(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
    std::vector<glm::vec3> all;
    for (int i = 0; i < count; ++i) all.push_back({coordinate(random), coordinate(random), coordinate(random)});
    return all;
}

// A ball of radius 1 in layers: one phase to 0.5, another to 1.
embree::Tree layers() {
    return embree::Tree::from_text(R"({"phases": {"skin": 0, "core": 0}, "tree": {"under": [
        {"set": {"phase": "skin", "of": {"sphere": {"radius": 1}}}},
        {"set": {"phase": "core", "of": {"sphere": {"radius": 0.5}}}}]}})");
}

float true_distance(const glm::vec3& p) {
    const float r = glm::length(p);
    return std::min(std::abs(r - 1), std::abs(r - 0.5f));
}

}  // namespace

TEST_CASE("phases and distances are the tree's") {
    const Placed placed;
    const Phased tree = object();
    int material = 0;
    for (const glm::vec3& p : points(2000, 61)) {
        const Phases<float> phi = distances(tree, p);
        float radius = -1;
        const unsigned phase = placed.geometry.phase(arr(p), 0, &radius);
        REQUIRE(phase == label(phi).index);
        material += phase != 0;
        const auto all = placed.geometry.distances(arr(p));
        for (int i = 0; i < PHASETREE_MAX_PHASES; ++i) {
            if (phi.has(i))
                REQUIRE(all[static_cast<std::size_t>(i)] == phi[i]);
            else
                REQUIRE(all[static_cast<std::size_t>(i)] == infinity);
        }
        REQUIRE(radius >= 0);
        // No other phase anywhere on the ball's rim.
        for (const glm::vec3& d : points(4, 62))
            REQUIRE(label(distances(tree, p + 0.999f * radius * glm::normalize(d))).index == phase);
    }
    CHECK(material > 200);
}

TEST_CASE("the closest interface of a ball in layers is where geometry says") {
    const Placed placed(layers());
    const float resolution = placed.geometry.statistics().resolution;
    for (const glm::vec3& p : points(300, 63)) {
        for (const float tolerance : {0.01f, 0.3f}) {
            CAPTURE(tolerance);
            const PhasetreeClosest c = placed.geometry.closest(arr(p), infinity, tolerance);
            const float expected = true_distance(p);
            REQUIRE(c.found);
            REQUIRE(c.emptyRadius <= expected + 1e-6f);
            REQUIRE(c.distance >= expected - 4 * resolution);
            REQUIRE(c.distance <= expected * (1 + 2 * tolerance) + 8 * resolution);
            REQUIRE(c.emptyRadius >= c.distance * (1 - tolerance) - 8 * resolution);
            REQUIRE(glm::distance(vec(c.point), p) == doctest::Approx(c.distance).epsilon(1e-4));
            REQUIRE(true_distance(vec(c.point)) < 4 * resolution);
            REQUIRE(c.from != c.to);
        }
        // Nothing is closer, so the radius stays as it is.
        const float expected = true_distance(p);
        if (expected < 0.01f) continue;
        const PhasetreeClosest none = placed.geometry.closest(arr(p), 0.9f * expected);
        REQUIRE_FALSE(none.found);
        REQUIRE(none.emptyRadius >= 0.9f * expected * 0.999f);
    }
    CHECK(placed.geometry.closest({0.9f, 0, 0}, infinity).to == 0);
    CHECK(placed.geometry.closest({0.9f, 0, 0}, infinity).from == 1);
    CHECK(placed.geometry.closest({30, 40, 0}, infinity).distance == doctest::Approx(49).epsilon(1e-4));
}

TEST_CASE("the closest interface is never one between two opaque phases") {
    const embree::Tree tree =
        embree::Tree::from_text(R"({"phases": {"core": 0, "shell": 0, "water": 0}, "tree": {"over": [
        {"set": {"phase": "core", "of": {"sphere": {"radius": 1}}}},
        {"set": {"phase": "shell", "of": {"sphere": {"radius": 2}}}},
        {"set": {"phase": "water", "of": {"sphere": {"radius": 3}}}}]}})");
    PhasetreeGeometryOptions options = embree::default_options();
    options.opaquePhases = 0b0110;
    const Placed placed(tree, options);
    for (const float x : {0.9f, 1.1f, 1.6f, 2.4f}) {
        const PhasetreeClosest c = placed.geometry.closest({x, 0, 0}, infinity);
        REQUIRE(c.found);
        CHECK(c.distance == doctest::Approx(std::abs(2 - x)).epsilon(0.02));
        CHECK(c.emptyRadius <= c.distance);
        CHECK(c.emptyRadius > 0.9f * c.distance);
    }
    CHECK(placed.geometry.closest({2.7f, 0, 0}, infinity).distance == doctest::Approx(0.3).epsilon(0.02));
}

TEST_CASE("the closest interface of an object of many operators: nothing is nearer") {
    const Placed placed;
    const Phased tree = object();
    std::mt19937 random(64);
    std::normal_distribution<float> normal;
    for (const glm::vec3& p : points(60, 65)) {
        const PhasetreeClosest c = placed.geometry.closest(arr(p), infinity);
        REQUIRE(c.found);
        REQUIRE(c.emptyRadius <= c.distance);
        const unsigned phase = placed.geometry.phase(arr(p));
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
            REQUIRE(label(distances(tree, p + 0.999f * c.emptyRadius * d)).index == phase);
        }
        // Both phases are at the point, to within the resolution.
        bool here = false, there = false;
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 d(normal(random), normal(random), normal(random));
            const unsigned l =
                label(distances(tree, vec(c.point) + 3 * placed.geometry.statistics().resolution * d)).index;
            here = here || l == c.from;
            there = there || l == c.to;
        }
        REQUIRE(here);
        REQUIRE(there);
    }
}

TEST_CASE("where the geometry is placed and moves") {
    Placed placed(layers());
    placed.geometry.set_motion({{2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0}, {2, 0, 0, 0, 2, 0, 0, 0, 2, 10, 0, 0}});
    float radius = 0;
    CHECK(placed.geometry.phase({0, 0, 0}, 0, &radius) == 2);
    CHECK(radius == doctest::Approx(1).epsilon(1e-3));
    CHECK(placed.geometry.phase({0, 0, 0}, 1, &radius) == 0);
    CHECK(radius > 7);  // to the object's box
    CHECK(radius <= 8);
    CHECK(placed.geometry.closest({0, 0, 0}, infinity, 0.01f, 0.5f).distance == doctest::Approx(3).epsilon(0.01));
    CHECK(placed.geometry.distances({10, 0, 0}, 1)[2] == doctest::Approx(-0.5));
}

namespace {

struct Queried {
    RTCPointQuery query{};
    PhasetreePointQuery result{};
};

Queried ask(RTCScene scene, const glm::vec3& p, float radius, const std::vector<PhasetreePointQueryGeometry>& listed,
            RTCPointQueryFunction function) {
    Queried q;
    q.query.x = p.x, q.query.y = p.y, q.query.z = p.z;
    q.query.radius = radius;
    q.result.apiVersion = PHASETREE_API_VERSION;
    q.result.geometries = listed.data();
    q.result.geometryCount = static_cast<unsigned>(listed.size());
    q.result.tolerance = 0.01f;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &q.query, &context, function, &q.result);
    return q;
}

}  // namespace

TEST_CASE("Embree's point queries find the nearest of geometries and instances") {
    Device device;
    const embree::Geometry own(device, layers()),
        registered(device, layers(), with_flags(PHASETREE_GEOMETRY_FLAG_POINT_QUERY));
    EmbreeScene inner(device), outer(device);
    inner.add(own.embree());
    inner.commit();
    outer.add(registered.embree());  // 0
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    const float matrix[12] = {0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 3, 0, 0};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    const unsigned instance_id = outer.add(instance);
    rtcReleaseGeometry(instance);
    outer.commit();
    const std::vector<PhasetreePointQueryGeometry> listed = {{0, RTC_INVALID_GEOMETRY_ID, registered.get()},
                                                             {0, instance_id, own.get()}};
    for (const glm::vec3& around : points(200, 66)) {
        const glm::vec3 p = around + glm::vec3(1.5f, 0, 0);
        const float to_first = true_distance(p), to_second = 0.5f * true_distance(2.0f * (p - glm::vec3(3, 0, 0)));
        const float expected = std::min(to_first, to_second);
        const Queried q = ask(outer, p, infinity, listed, phasetreePointQueryFunction);
        REQUIRE(q.result.closest.found);
        REQUIRE(q.result.closest.distance == doctest::Approx(expected).epsilon(0.02).scale(1e-3));
        REQUIRE(q.query.radius == q.result.closest.distance);
        REQUIRE(glm::distance(vec(q.result.closest.point), p) == doctest::Approx(q.query.radius).epsilon(1e-4));
        if (std::abs(to_first - to_second) > 0.05f)
            REQUIRE(q.result.instID == (to_first < to_second ? RTC_INVALID_GEOMETRY_ID : instance_id));
        // The registered one answers also where no function is given.
        const Queried r = ask(outer, p, infinity, listed, nullptr);
        REQUIRE(r.result.closest.distance == doctest::Approx(to_first).epsilon(0.02).scale(1e-3));
    }
    CHECK_FALSE(ask(outer, {0, 0, 5}, 1, listed, phasetreePointQueryFunction).result.closest.found);
    CHECK_FALSE(ask(outer, {0, 0, 2}, 3, {}, phasetreePointQueryFunction).result.closest.found);
}

TEST_CASE("point queries through instances that are no similarities") {
    Device device;
    const embree::Geometry own(device, layers());
    EmbreeScene inner(device), outer(device);
    inner.add(own.embree());
    inner.commit();
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    const float matrix[12] = {3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};  // an ellipsoid
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    const unsigned id = outer.add(instance);
    rtcReleaseGeometry(instance);
    outer.commit();
    const std::vector<PhasetreePointQueryGeometry> listed = {{0, id, own.get()}};
    CHECK(ask(outer, {4, 0, 0}, infinity, listed, phasetreePointQueryFunction).result.closest.distance ==
          doctest::Approx(1).epsilon(0.02));
    CHECK(ask(outer, {0, 2, 0}, infinity, listed, phasetreePointQueryFunction).result.closest.distance ==
          doctest::Approx(1).epsilon(0.02));
    CHECK(ask(outer, {0, 0, 0}, infinity, listed, phasetreePointQueryFunction).result.closest.distance ==
          doctest::Approx(0.5).epsilon(0.02));
}

}  // namespace test_points
