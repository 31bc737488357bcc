// Packets of any size, coherent or not, in scenes of any kind, give the same results as single rays. Inactive lanes,
// and lanes that hit nothing, keep every bit.
#include "embree/api/api.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_packets {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// How often some lane hit and some lane missed.
struct Seen {
    int hit = 0, missed = 0, inactive = 0;
};

template <int N>
void check_packets(RTCScene scene, const std::vector<RTCRayHit>& before, const std::vector<RTCRayHit>& one,
                   bool coherent, Seen& seen) {
    CAPTURE(N);
    CAPTURE(coherent);
    for (std::size_t first = 0; first + N <= before.size(); first += N) {
        alignas(64) int valid[N];
        typename PacketOf<N>::Both packet{};
        typename PacketOf<N>::Rays shadow{};
        for (unsigned i = 0; i < N; ++i) {
            valid[i] = N > 1 && (first / N + i) % 3 == 2 ? 0 : -1;
            put<N>(packet, i, before[first + i]);
            put_ray<N>(&shadow, i, before[first + i].ray);
        }
        query<N>(scene, valid, packet, {.coherent = coherent});
        query<N>(scene, valid, shadow, {.coherent = coherent});
        for (unsigned i = 0; i < N; ++i) {
            CAPTURE(first);
            CAPTURE(i);
            const bool is_active = valid[i] == -1;
            const RTCRayHit& expected = is_active ? one[first + i] : before[first + i];
            REQUIRE(same_bits(get<N>(packet, i), expected));
            RTCRay dark = before[first + i].ray;
            if (is_active && hits(one[first + i])) dark.tfar = -infinity;
            REQUIRE(same_bits(get_ray<N>(&shadow, i), dark));
            ++(!is_active ? seen.inactive : hits(expected) ? seen.hit : seen.missed);
        }
    }
}

}  // namespace

TEST_CASE("packets of 1, 4, 8 and 16 are single rays, in scenes of all flags and qualities") {
    Device device;
    const embree::Geometry geometry(device, object_tree());
    std::vector<RTCRayHit> before, one;
    for (const Ray& ray : rays(320, 3)) before.push_back(marked(ray, 0, before.size() % 5 == 0 ? 1.5f : infinity));

    const int flags[] = {RTC_SCENE_FLAG_NONE,
                         RTC_SCENE_FLAG_DYNAMIC,
                         RTC_SCENE_FLAG_COMPACT,
                         RTC_SCENE_FLAG_ROBUST,
                         RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_ROBUST,
                         1 << 3};  // filters among a query's arguments, whatever Embree calls it
    for (const int scene_flags : flags) {
        for (const RTCBuildQuality quality :
             {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH}) {
            for (const RTCBuildQuality own : {RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_REFIT}) {
                CAPTURE(scene_flags);
                CAPTURE(quality);
                CAPTURE(own);
                const RTCScene scene = new_scene(device, scene_flags, quality);
                rtcSetGeometryBuildQuality(geometry.embree(), own);
                rtcCommitGeometry(geometry.embree());
                rtcAttachGeometry(scene, geometry.embree());
                rtcCommitScene(scene);
                if (one.empty())
                    for (const RTCRayHit& ray : before) one.push_back(trace_one(scene, ray));
                Seen seen;
                for (const bool coherent : {false, true}) {
                    check_packets<1>(scene, before, one, coherent, seen);
                    check_packets<4>(scene, before, one, coherent, seen);
                    check_packets<8>(scene, before, one, coherent, seen);
                    check_packets<16>(scene, before, one, coherent, seen);
                }
                CHECK(seen.hit > 500);
                CHECK(seen.missed > 200);
                CHECK(seen.inactive > 500);
                rtcReleaseScene(scene);
            }
        }
    }
}

TEST_CASE("hits are the crossings of the whole object's program, whatever Embree does around it") {
    const Placed placed;
    const InterfaceTracer tracer(object());
    Evaluator::Workspace workspace;
    int hit = 0;
    for (const Ray& ray : rays(4000, 1)) {
        const RTCRayHit r = trace_one(placed.scene, rayhit(ray));
        const auto expected = tracer.first_crossing(ray.origin, ray.direction, 0, 1e30f, std::nullopt, workspace);
        REQUIRE(hits(r) == expected.has_value());
        REQUIRE(occluded_one(placed.scene, rayhit(ray)) == hits(r));
        if (!expected) continue;
        ++hit;
        REQUIRE(same_place(r.ray.tfar, expected->t_from, tracer.resolution()));
        REQUIRE(r.hit.u == expected->from.index);
        REQUIRE(r.hit.v == expected->to.index);
        REQUIRE(r.hit.geomID == placed.id);
        REQUIRE(r.hit.primID < placed.geometry.statistics().cells);
        const glm::vec3 normal(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z);
        REQUIRE(glm::length(normal) == doctest::Approx(1).epsilon(1e-5));
        REQUIRE(glm::dot(normal, ray.direction) < 0);
    }
    CHECK(hit > 2000);
}

TEST_CASE("without filters the same is hit") {
    const Placed with, without(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_NO_FILTERS));
    for (const Ray& ray : rays(1000, 2)) {
        const RTCRayHit a = trace_one(with.scene, rayhit(ray)), b = trace_one(without.scene, rayhit(ray));
        REQUIRE(same_bits(a, b));
        REQUIRE(occluded_one(without.scene, rayhit(ray)) == hits(a));
    }
}

TEST_CASE("occluded agrees with intersect, whatever the segment") {
    const Placed placed;
    std::mt19937 random(4);
    const float resolution = placed.geometry.statistics().resolution;
    for (const Ray& ray : rays(1000, 5)) {
        const RTCRayHit r = trace_one(placed.scene, rayhit(ray));
        if (!hits(r) || r.ray.tfar < 0.01f) continue;
        REQUIRE_FALSE(occluded_one(placed.scene, rayhit(ray, 0, r.ray.tfar - 8 * resolution)));
        REQUIRE(occluded_one(placed.scene, rayhit(ray, 0, r.ray.tfar + 8 * resolution)));
        const float far = std::uniform_real_distribution<float>(0, 4)(random);
        if (same_place(far, r.ray.tfar, resolution)) continue;
        REQUIRE(occluded_one(placed.scene, rayhit(ray, 0, far)) == (r.ray.tfar < far));
        REQUIRE(hits(trace_one(placed.scene, rayhit(ray, 0, far))) == (r.ray.tfar < far));
    }
}

#if PHASETREE_EMBREE_MAJOR == 3
TEST_CASE("Embree 3: streams are single rays") {
    const Placed placed;
    std::vector<RTCRayHit> before;
    for (const Ray& ray : rays(1000, 9)) before.push_back(marked(ray));
    for (const bool coherent : {false, true}) {
        std::vector<RTCRayHit> stream = before;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        rtcIntersect1M(placed.scene, &context, stream.data(), static_cast<unsigned>(stream.size()), sizeof(RTCRayHit));
        for (std::size_t i = 0; i < before.size(); ++i) {
            const RTCRayHit one = trace_one(placed.scene, before[i]);
            REQUIRE(hits(stream[i]) == hits(one));
            if (hits(one)) REQUIRE(same_bits(stream[i], one));
        }
    }
}
#endif

}  // namespace test_packets
