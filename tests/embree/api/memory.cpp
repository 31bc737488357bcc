// Builds that Embree's memory monitor cancels: an error, nothing leaked, and the next one works.
#include <atomic>

#include "embree/api/api.hpp"

namespace test_memory {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// What Embree has, and how much of it is allowed.
struct Monitor {
    std::atomic<std::ptrdiff_t> bytes{0}, most{0};
    std::ptrdiff_t limit = PTRDIFF_MAX;

    static bool account(void* user, ssize_t bytes, bool post) {
        auto& m = *static_cast<Monitor*>(user);
        const std::ptrdiff_t now = m.bytes += bytes;
        if (now > m.most) m.most = now;
        // After the fact, or for what is given back, there is nothing to refuse. What is rejected is not allocated.
        if (post || bytes <= 0 || now <= m.limit) return true;
        m.bytes -= bytes;
        return false;
    }
};

}  // namespace

TEST_CASE("a build that the memory monitor cancels leaks nothing, and the next one works") {
    Monitor monitor;
    {
        Device device;
        rtcSetDeviceMemoryMonitorFunction(device, Monitor::account, &monitor);
        const embree::Tree tree = object_tree();
        { const embree::Geometry whole(device, tree); }
        const std::ptrdiff_t need = monitor.most - monitor.bytes;
        REQUIRE(need > 0);
        int cancelled = 0;
        for (int i = 0; i < 20; ++i) {
            const std::ptrdiff_t before = monitor.bytes;
            monitor.limit = before + need * i / 20;
            PhasetreeGeometry geometry = nullptr;
            const PhasetreeError error =
                phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree.get(), nullptr, &geometry);
            if (error == PHASETREE_ERROR_NONE) {
                // Embree rounds; with almost everything it may do.
                CHECK(i > 5);
                phasetreeReleaseGeometry(geometry);
            } else {
                ++cancelled;
                CHECK(geometry == nullptr);
                CHECK((error == PHASETREE_ERROR_CANCELLED || error == PHASETREE_ERROR_OUT_OF_MEMORY));
            }
            CHECK(rtcGetDeviceError(device) == RTC_ERROR_NONE);
            CHECK(monitor.bytes == before);
        }
        CHECK(cancelled > 5);

        // An edit that is cancelled leaves what was there; afterwards it goes.
        monitor.limit = PTRDIFF_MAX;
        embree::Geometry geometry(device, tree);
        EmbreeScene scene(device);
        scene.add(geometry.embree());
        scene.commit();
        const RTCRayHit ray = rayhit({{0.01f, -3, 0.02f}, {0, 1, 0}});
        const RTCRayHit before = trace_one(scene, ray);
        monitor.limit = monitor.bytes;
        CHECK_THROWS_AS(geometry.set_tree(tree.edited(
                            "/tree/under/2", R"({"set": {"phase": "sand", "of": {"sphere": {"radius": 2}}}})")),
                        embree::Error);
        CHECK(same_bits(trace_one(scene, ray), before));
        monitor.limit = PTRDIFF_MAX;
        geometry.set_tree(
            tree.edited("/tree/under/2", R"({"set": {"phase": "sand", "of": {"sphere": {"radius": 2}}}})"));
        rtcCommitGeometry(geometry.embree());
        scene.commit();
        CHECK(trace_one(scene, ray).hit.v == 4);

        // A scene's own commit cancelled, and done again.
        monitor.limit = monitor.bytes;
        EmbreeScene second(device);
        second.add(geometry.embree());
        second.commit();
        const RTCError error = rtcGetDeviceError(device);
        monitor.limit = PTRDIFF_MAX;
        if (error != RTC_ERROR_NONE) second.commit();
        CHECK(rtcGetDeviceError(device) == RTC_ERROR_NONE);
        CHECK(trace_one(second, ray).hit.v == 4);
    }
    CHECK(monitor.bytes == 0);
}

TEST_CASE("a build that the application cancels") {
    Device device;
    struct State {
        std::atomic<int> asked{0};
        int limit = 0;
    } state;
    PhasetreeGeometryOptions options = embree::default_options();
    options.cancelledUserPtr = &state;
    options.cancelled = [](void* user) {
        auto& s = *static_cast<State*>(user);
        return ++s.asked > s.limit;
    };
    PhasetreeGeometry geometry = nullptr;
    const embree::Tree tree = object_tree();
    for (const int limit : {0, 3, 50}) {
        state.asked = 0;
        state.limit = limit;
        CHECK(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree.get(), &options, &geometry) ==
              PHASETREE_ERROR_CANCELLED);
        CHECK(geometry == nullptr);
    }
    state.limit = 1 << 30;
    CHECK(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree.get(), &options, &geometry) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeReleaseGeometry(geometry) == PHASETREE_ERROR_NONE);
}

}  // namespace test_memory
