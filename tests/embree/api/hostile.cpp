// Invalid rays, passed directly to the callbacks: they end, and write nothing.
#include <chrono>

#include "embree/api/api.hpp"

namespace test_hostile {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

template <int N>
void check_untouched(PhasetreeGeometry geometry, const RTCRayHit& bad) {
    alignas(64) int valid[N];
    typename PacketOf<N>::Both packet{};
    typename PacketOf<N>::Rays shadow{};
    for (unsigned i = 0; i < N; ++i) {
        valid[i] = -1;
        put<N>(packet, i, bad);
        put_ray<N>(&shadow, i, bad.ray);
    }
    embree::Context context;
    embree::initialise(context);
    RTCIntersectFunctionNArguments intersect{};
    intersect.valid = valid;
    intersect.geometryUserPtr = geometry;
    intersect.context = &context;
    intersect.rayhit = reinterpret_cast<RTCRayHitN*>(&packet);
    intersect.N = N;
    phasetreeIntersectFunction(&intersect);
    RTCOccludedFunctionNArguments occluded{};
    occluded.valid = valid;
    occluded.geometryUserPtr = geometry;
    occluded.context = &context;
    occluded.ray = reinterpret_cast<RTCRayN*>(&shadow);
    occluded.N = N;
    phasetreeOccludedFunction(&occluded);
    for (unsigned i = 0; i < N; ++i) {
        CAPTURE(i);
        CHECK(same_bits(get<N>(packet, i), bad));
        CHECK(same_bits(get_ray<N>(&shadow, i), bad.ray));
        CHECK(valid[i] == -1);
    }
}

void check_untouched(PhasetreeGeometry geometry, const RTCRayHit& bad) {
    check_untouched<1>(geometry, bad);
    check_untouched<4>(geometry, bad);
    check_untouched<8>(geometry, bad);
    check_untouched<16>(geometry, bad);
}

}  // namespace

TEST_CASE("rays that are none hit nothing and are not touched") {
    Device device;
    embree::Geometry geometry(device, object_tree());
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::max();
    const glm::vec3 from(0.01f, -3, 0.02f), up(0, 1, 0);
    std::vector<RTCRayHit> bad = {marked({from, {0, 0, 0}}),
                                  marked({from, {0, 1e-30f, 0}}),
                                  marked({from, {0, nan, 0}}),
                                  marked({from, {nan, nan, nan}}),
                                  marked({from, {0, infinity, 0}}),
                                  marked({from, {nan, 1, 0}}),
                                  marked({{nan, -3, 0}, up}),
                                  marked({{0, infinity, 0}, up}),
                                  marked({{0, -infinity, 0}, up}),
                                  marked({{0, huge, 0}, up}),
                                  marked({{0, 1e30f, 0}, {0, -1, 0}}),
                                  marked({from, up}, 5, 1),
                                  marked({from, up}, nan, 10),
                                  marked({from, up}, 0, nan),
                                  marked({from, up}, 0, -1),
                                  marked({from, up}, 0, -infinity),
                                  marked({from, up}, infinity, infinity),
                                  marked({from, {0, huge, 0}}),
                                  marked({from, up}, huge, infinity)};
    // Any combination of odd numbers in any member.
    std::mt19937 random(41);
    const float odd[] = {nan, infinity, -infinity, huge, -huge, 1e-45f, 0.0f, -0.0f, 1e20f, 1e-20f};
    const auto pick = [&] { return odd[random() % std::size(odd)]; };
    const auto start = std::chrono::steady_clock::now();
    for (const RTCRayHit& ray : bad) {
        CAPTURE(&ray - bad.data());
        check_untouched(geometry.get(), ray);
    }
    // Some of these may be rays; they still end, and never touch memory outside them.
    for (int i = 0; i < 20'000; ++i) {
        RTCRayHit ray = marked({from, {pick(), pick(), pick()}}, pick(), pick());
        if (random() % 2 == 0) ray.ray.org_x = pick();
        if (random() % 2 == 0) ray.ray.org_y = pick();
        ray.ray.time = pick();
        alignas(64) int valid[1] = {-1};
        embree::Context context;
        embree::initialise(context);
        RTCOccludedFunctionNArguments occluded{};
        occluded.valid = valid;
        occluded.context = &context;
        occluded.ray = reinterpret_cast<RTCRayN*>(&ray.ray);
        occluded.N = 1;
        // Without filters: those need Embree's own arguments.
        const RTCRayHit before = ray;
        const glm::vec3 d(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z);
        if (glm::length(d) > 0 && std::isfinite(glm::length(d))) continue;
        occluded.geometryUserPtr = geometry.get();
        phasetreeOccludedFunction(&occluded);
        REQUIRE(same_bits(ray.ray, before.ray));
    }
    // Seconds, where a hang would be for ever.
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));

    // So they do where the geometry moves, at any time.
    const float transforms[24] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 5};
    REQUIRE(phasetreeSetGeometryMotion(geometry.get(), transforms, 2, 0, 1) == PHASETREE_ERROR_NONE);
    for (RTCRayHit ray : bad) {
        ray.ray.time = nan;
        check_untouched(geometry.get(), ray);
    }
}

TEST_CASE("odd but sound rays end in bounded time, through Embree") {
    // Rays along faces of cells and interfaces, far away, long and short: no bound on time but the test's own.
    const Placed placed;
    int hit = 0;
    for (const float far : {10.0f, 1e3f, 1e6f, 1e12f}) {
        for (int i = 0; i < 200; ++i) {
            const float a = 0.0314f * static_cast<float>(i);
            const glm::vec3 d(std::cos(a), std::sin(a), 0.1f * std::sin(3 * a));
            hit += hits(trace_one(placed.scene, rayhit({-far * d, d})));
            hit += hits(trace_one(placed.scene, rayhit({{0, 0, -1.1f}, {std::cos(a), std::sin(a), 0}})));
        }
    }
    CHECK(hit > 800);
}

TEST_CASE("what is not ours is left alone: foreign and stale user pointers make empty geometries") {
    Device device;
    int foreign = 0;
    const embree::Tree tree = object_tree();
    RTCGeometry kept = nullptr;
    EmbreeScene scene(device);
    {
        const embree::Geometry geometry(device, tree);
        kept = geometry.embree();
        scene.add(kept);
        scene.commit();
        CHECK(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
        rtcSetGeometryUserData(kept, &foreign);
        CHECK_FALSE(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
        rtcSetGeometryUserData(kept, geometry.get());
        CHECK(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
    }
    // The handle is freed, the scene still has the geometry: nothing there, until the scene is gone.
    CHECK_FALSE(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
    CHECK_FALSE(occluded_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}})));
    rtcCommitGeometry(kept);
    scene.commit();
    CHECK_FALSE(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
}

}  // namespace test_hostile
