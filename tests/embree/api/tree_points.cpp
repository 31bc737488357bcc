// Places in the tree's own space, where solid textures are, under motion and instances.
#include <glm/matrix.hpp>

#include "embree/api/api.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_tree_points {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

using Matrix = std::array<float, 12>;
const Matrix first{0.8f, 0.3f, 0, -0.2f, 1.1f, 0, 0, 0.1f, 0.9f, 0.5f, -0.25f, 1},
    last{0.4f, 0.7f, 0, -0.9f, 0.6f, 0, 0, 0.1f, 1.2f, -1, 0.75f, 0.5f},
    instance{-2, 0.2f, 0, 0.4f, 1.5f, 0, 0, 0.3f, 1, 10, -20, 4};

Matrix between(float f) {
    Matrix m{};
    for (std::size_t i = 0; i < m.size(); ++i) m[i] = (1 - f) * first[i] + f * last[i];
    return m;
}

}  // namespace

TEST_CASE("a hit's place in the tree's space is where the object has it, moved and instanced") {
    Placed inner;
    inner.geometry.set_motion({first, last});
    rtcCommitGeometry(inner.geometry.embree());
    inner.scene.commit();
    EmbreeScene outer(inner.device);
    const RTCGeometry placed = rtcNewGeometry(inner.device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(placed, inner.scene);
    rtcSetGeometryTransform(placed, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, instance.data());
    outer.add(placed);
    rtcReleaseGeometry(placed);
    outer.commit();
    const InterfaceTracer tracer(object());
    Evaluator::Workspace workspace;
    int hit = 0;
    for (const float time : {0.0f, 0.3f, 1.0f}) {
        const ColumnMap to_geometry(between(time)), to_world(instance);
        for (const Ray& ray : rays(500, 93)) {
            // Given in the tree's space, and traced in the world.
            const glm::dvec3 o = to_world(to_geometry(ray.origin)),
                             d = to_world.linear * to_geometry.linear * glm::dvec3(ray.direction);
            RTCRayHit r = rayhit({glm::vec3(o), glm::vec3(d)});
            r.ray.time = time;
            r = trace_one(outer, r);
            if (!hits(r)) continue;
            ++hit;
            const std::array<float, 3> there = inner.geometry.tree_point(r, instance.data());
            const glm::vec3 expected = ray.origin + r.ray.tfar * ray.direction;
            REQUIRE(glm::distance(vec(there.data()), expected) < 3e-5f);
            const PhasetreeHit decoded = inner.geometry.decode(r, instance.data());
            const std::array<float, 3> in = inner.geometry.tree_point(arr(vec(decoded.pointFrom)), time);
            REQUIRE(glm::distance(vec(in.data()), expected) < 3e-5f);
            REQUIRE(glm::distance(glm::dvec3(vec(decoded.pointFrom)), to_geometry(expected)) < 1e-4);
            // By the tree alone: the interface is there.
            REQUIRE(std::abs(tracer.evaluator().distances(vec(there.data()), workspace)[static_cast<int>(r.hit.u)]) <
                    5e-5f);
        }
    }
    CHECK(hit > 500);
}

TEST_CASE("without motion the tree's space is the geometry's, bit for bit") {
    const Placed placed;
    for (const Ray& ray : rays(50, 94)) CHECK(placed.geometry.tree_point(arr(ray.origin), 0.3f) == arr(ray.origin));
}

TEST_CASE("places in the tree's space that are asked for wrongly") {
    Placed placed;
    const PhasetreeGeometry g = placed.geometry.get();
    const RTCRayHit good = trace_one(placed.scene, rayhit({{0, -3, 0}, {0, 1, 0}}));
    RTCRayHit miss = good, instanced = good;
    miss.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    instanced.hit.instID[0] = 0;
    float out[3] = {1, 2, 3};
    const float p[3] = {0, 0, 0}, nan[3] = {0, std::numeric_limits<float>::quiet_NaN(), 0}, flat[12] = {};
    const auto invalid = PHASETREE_ERROR_INVALID_ARGUMENT, not_now = PHASETREE_ERROR_INVALID_OPERATION,
               no_handle = PHASETREE_ERROR_INVALID_HANDLE;
    expect_error(phasetreeGetHitTreePoint(nullptr, &good, nullptr, out), no_handle, "geometry is NULL");
    expect_error(phasetreeGetHitTreePoint(g, nullptr, nullptr, out), invalid, "rayhit");
    expect_error(phasetreeGetHitTreePoint(g, &good, nullptr, nullptr), invalid, "treePoint");
    expect_error(phasetreeGetHitTreePoint(g, &miss, nullptr, out), not_now, "hit nothing");
    expect_error(phasetreeGetHitTreePoint(g, &instanced, nullptr, out), invalid, "objectToWorld is NULL");
    expect_error(phasetreeGetHitTreePoint(g, &instanced, flat, out), invalid, "no inverse");
    expect_error(phasetreeGetTreePoint(nullptr, p, 0, out), no_handle, "geometry is NULL");
    expect_error(phasetreeGetTreePoint(g, nullptr, 0, out), invalid, "point is NULL");
    expect_error(phasetreeGetTreePoint(g, nan, 0, out), invalid, "finite");
    expect_error(phasetreeGetTreePoint(g, p, 0, nullptr), invalid, "treePoint");
    PhasetreeGeometry freed = nullptr;
    {
        const embree::Geometry gone(placed.device, placed.tree);
        freed = gone.get();
    }
    expect_error(phasetreeGetHitTreePoint(freed, &good, nullptr, out), no_handle, "released");
    expect_error(phasetreeGetTreePoint(freed, p, 0, out), no_handle, "released");
    // Half a turn passes through a matrix without inverse.
    const Matrix straight{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, turned{-1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0};
    placed.geometry.set_motion({straight, turned});
    expect_error(phasetreeGetTreePoint(g, p, 0.5f, out), not_now, "no inverse");
    CHECK(out[0] == 1);
    CHECK(out[1] == 2);
    CHECK(out[2] == 3);
}

}  // namespace test_tree_points
