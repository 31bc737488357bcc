// Motion of the whole geometry by time steps: at each time, it equals a geometry that stands still at that position.
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "embree/api/api.hpp"

namespace test_motion {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

using Matrix = std::array<float, 12>;

Matrix turned(float degrees, const glm::vec3& scale, const glm::vec3& shift) {
    const float a = glm::radians(degrees), c = std::cos(a), s = std::sin(a);
    return {scale.x * c, scale.x * s, 0, -scale.y * s, scale.y * c, 0, 0, 0, scale.z, shift.x, shift.y, shift.z};
}

// Entry by entry, as Embree interpolates.
Matrix at(const std::vector<Matrix>& steps, float time) {
    const float x = time * static_cast<float>(steps.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(x), steps.size() - 2);
    const float f = x - static_cast<float>(i);
    Matrix m{};
    for (std::size_t k = 0; k < 12; ++k) m[k] = (1 - f) * steps[i][k] + f * steps[i + 1][k];
    return m;
}

const std::vector<Matrix> motion = {turned(0, {1, 1, 1}, {0, 0, 0}), turned(40, {1, 1.3f, 0.8f}, {0.5f, 0, 0.2f}),
                                    turned(100, {0.7f, 1, 1}, {0.5f, 0.5f, 0})};

RTCRayHit timed(const Ray& ray, float time) {
    RTCRayHit r = marked(ray);
    r.ray.time = time;
    return r;
}

}  // namespace

TEST_CASE("a moving geometry is at each time the one that stands there") {
    Placed moving;
    moving.geometry.set_motion(motion);
    rtcCommitGeometry(moving.geometry.embree());
    moving.scene.commit();
    const float resolution = moving.geometry.statistics().resolution;
    for (const float time : {0.0f, 0.1f, 0.5f, 0.77f, 1.0f}) {
        CAPTURE(time);
        Placed standing;
        standing.geometry.set_motion({at(motion, time)});
        rtcCommitGeometry(standing.geometry.embree());
        standing.scene.commit();
        int hit = 0;
        for (const Ray& ray : rays(600, 51)) {
            const RTCRayHit a = trace_one(moving.scene, timed(ray, time)), b = trace_one(standing.scene, timed(ray, 0));
            REQUIRE(occluded_one(moving.scene, timed(ray, time)) == hits(a));
            // Matrices that agree to an ulp: rays that graze may differ.
            if (hits(a) != hits(b)) continue;
            if (!hits(a)) {
                REQUIRE(same_bits(a, timed(ray, time)));
                continue;
            }
            ++hit;
            const glm::vec3 na(a.hit.Ng_x, a.hit.Ng_y, a.hit.Ng_z), nb(b.hit.Ng_x, b.hit.Ng_y, b.hit.Ng_z);
            REQUIRE(glm::length(na) == doctest::Approx(1).epsilon(1e-5));
            const float cosine = std::abs(glm::dot(nb, ray.direction));
            if (cosine < 0.02f) continue;
            REQUIRE(std::abs(a.ray.tfar - b.ray.tfar) < 16 * resolution / cosine);
            if (a.hit.primID != b.hit.primID) continue;
            REQUIRE(a.hit.u == b.hit.u);
            REQUIRE(glm::dot(na, ray.direction) < 0);
            const PhasetreeHit decoded = moving.geometry.decode(a);
            REQUIRE(glm::distance(vec(decoded.pointFrom), ray.origin + a.ray.tfar * ray.direction) < 16 * resolution);
        }
        CHECK(hit > 200);
    }
}

TEST_CASE("normals and points follow the placement: against an instance of the same matrix") {
    Placed standing;
    const Matrix m = turned(30, {1, 2, -0.5f}, {0.3f, 0, 0});
    standing.geometry.set_motion({m});
    rtcCommitGeometry(standing.geometry.embree());
    standing.scene.commit();
    Placed inner;
    EmbreeScene outer(inner.device);
    const RTCGeometry instance = rtcNewGeometry(inner.device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner.scene);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m.data());
    outer.add(instance);
    rtcReleaseGeometry(instance);
    outer.commit();
    const glm::mat3 linear(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]);
    int hit = 0;
    for (const Ray& ray : rays(600, 52)) {
        const RTCRayHit a = trace_one(standing.scene, rayhit(ray)), b = trace_one(outer, rayhit(ray));
        if (hits(a) != hits(b) || !hits(a) || a.hit.primID != b.hit.primID) continue;
        ++hit;
        const glm::vec3 own(b.hit.Ng_x, b.hit.Ng_y, b.hit.Ng_z);
        const glm::vec3 expected = glm::normalize(glm::transpose(glm::inverse(linear)) * own);
        if (std::abs(glm::dot(expected, ray.direction)) < 0.05f) continue;
        REQUIRE(glm::distance(glm::vec3(a.hit.Ng_x, a.hit.Ng_y, a.hit.Ng_z), expected) < 5e-3f);
        REQUIRE(std::abs(a.ray.tfar - b.ray.tfar) < 1e-3f);
    }
    CHECK(hit > 200);
}

TEST_CASE("rays that carry phases go through a moving object and out again") {
    Placed moving(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    moving.geometry.set_motion(motion);
    rtcCommitGeometry(moving.geometry.embree());
    moving.scene.commit();
    int crossings = 0;
    std::mt19937 random(53);
    for (const Ray& start : rays(2000, 54)) {
        const float time = std::uniform_real_distribution<float>(0, 1)(random);
        Ray ray = start;
        Carrying carrying{PhasetreeCarriedPhase{moving.id, RTC_INVALID_GEOMETRY_ID, RTC_INVALID_GEOMETRY_ID,
                                                moving.geometry.phase(arr(ray.origin), time)}};
        auto& [carried, state, context] = carrying;
        PhasetreeCarriedPhase& entry = carried.front();
        int of_this = 0;
        for (;; ++of_this) {
            RTCRayHit r = rayhit(ray);
            r.ray.time = time;
            query<1>(moving.scene, nullptr, r, {.context = &context.context});
            if (!hits(r)) break;
            REQUIRE(state.hit.from == entry.phase);
            entry.phase = state.hit.to;
            ray.origin = vec(state.hit.pointTo);
            REQUIRE(of_this < 50);
        }
        crossings += of_this;
        REQUIRE(entry.phase == 0);
    }
    CHECK(crossings > 2000);
}

TEST_CASE("a time range of its own, and back to standing still") {
    Placed moving;
    const Matrix here = turned(0, {1, 1, 1}, {0, 0, 0}), away = turned(0, {1, 1, 1}, {10, 0, 0});
    moving.geometry.set_motion({here, away}, 0.25f, 0.75f);
    rtcCommitGeometry(moving.geometry.embree());
    moving.scene.commit();
    const Ray ray{{0, -3, 0}, {0, 1, 0}};
    CHECK(hits(trace_one(moving.scene, timed(ray, 0.25f))));
    CHECK_FALSE(hits(trace_one(moving.scene, timed(ray, 0.6f))));
    CHECK(hits(trace_one(moving.scene, timed({{5, -3, 0}, {0, 1, 0}}, 0.5f))));
    CHECK(hits(trace_one(moving.scene, timed({{10, -3, 0}, {0, 1, 0}}, 0.7499f))));
    moving.geometry.set_motion({});
    rtcCommitGeometry(moving.geometry.embree());
    moving.scene.commit();
    CHECK(hits(trace_one(moving.scene, timed(ray, 0.6f))));
}

TEST_CASE("many time steps") {
    Placed moving;
    std::vector<Matrix> steps;
    for (int i = 0; i < RTC_MAX_TIME_STEP_COUNT; ++i)
        steps.push_back(turned(static_cast<float>(i), {1, 1, 1}, {0.01f * static_cast<float>(i), 0, 0}));
    moving.geometry.set_motion(steps);
    rtcCommitGeometry(moving.geometry.embree());
    moving.scene.commit();
    for (const float time : {0.0f, 0.3f, 0.999f}) {
        const float x = 1.28f * time;
        CHECK(hits(trace_one(moving.scene, timed({{x, -3, 0.01f}, {0, 1, 0}}, time))));
    }
    steps.push_back(steps.back());
    CHECK_THROWS_AS(moving.geometry.set_motion(steps), embree::Error);
}

}  // namespace test_motion
