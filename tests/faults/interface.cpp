// The C99 interface without memory: every call returns an error code, throws nothing and leaves everything as it was.
#include <cstring>
#include <functional>
#include <limits>
#include <thread>

#include "embree_core/rays.hpp"
#include "faults/support/child.hpp"
#include "faults/support/faults.hpp"
#include "phasetree/phasetree_embree.h"

namespace test_interface {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr const char* text = R"({"phases": {"a": {}, "b": {}}, "shapes": {"s": {"sphere": {"radius": 0.5}}},
    "tree": {"under": [{"thin_shell": {"of": {"box": {"size": [1, 1, 1]}}, "shell": "a", "inside": "b",
        "half_thickness": 0.1}}, {"set": {"phase": "b", "of": "s"}}]}})";

struct Session {
    RTCDevice device;
    PhasetreeTree tree = nullptr, edited = nullptr;
    PhasetreeGeometry geometry = nullptr;

    // Calls each in turn, also after one has failed; the first error that is none of those expected.
    PhasetreeError run() {
        PhasetreeError other = PHASETREE_ERROR_NONE;
        const auto call = [&](PhasetreeError error) {
            const bool is_expected = error == PHASETREE_ERROR_NONE || error == PHASETREE_ERROR_OUT_OF_MEMORY ||
                                     (error == PHASETREE_ERROR_INVALID_HANDLE && (!tree || !geometry));
            if (!is_expected && other == PHASETREE_ERROR_NONE) other = error;
        };
        call(phasetreeNewTreeFromText(PHASETREE_API_VERSION, text, std::strlen(text), nullptr, nullptr, &tree));
        call(phasetreeNewEditedTree(tree, "/shapes/s/sphere/radius", "0.6", &edited));
        PhasetreeGeometryOptions options;
        phasetreeInitGeometryOptions(&options);
        options.buildQuality = RTC_BUILD_QUALITY_LOW;
        options.cellDivisions = 5;
        call(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree, &options, &geometry));
        if (edited) call(phasetreeSetGeometryTree(geometry, edited, &options));
        const float m[24] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0};
        call(phasetreeSetGeometryMotion(geometry, m, 2, 0, 1));
        const float point[3] = {0.1f, 0.2f, 0.9f};
        unsigned phase = 0;
        PhasetreeClosest closest;
        PhasetreeGeometryStatistics statistics;
        call(phasetreeGetPhase(geometry, point, 0, &phase, nullptr));
        call(phasetreeFindClosestInterface(geometry, point, 0, 1, 0.1f, &closest));
        call(phasetreeGetGeometryStatistics(geometry, &statistics));
        return other;
    }
    void release() {
        if (geometry) phasetreeReleaseGeometry(geometry);
        if (edited) phasetreeReleaseTree(edited);
        if (tree) phasetreeReleaseTree(tree);
        geometry = nullptr;
        tree = edited = nullptr;
    }
};

std::size_t next(std::size_t n) {
    return long_tests() ? n + 1 : n + 1 + n / 20;
}

}  // namespace

TEST_CASE("calls return an error code") {
    // One thread: which allocation is the n-th does not depend on chance.
    const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    std::ptrdiff_t used = 0;
    rtcSetDeviceMemoryMonitorFunction(
        device,
        [](void* sum, ssize_t bytes, bool) {
            *static_cast<std::ptrdiff_t*>(sum) += bytes;
            return true;
        },
        &used);
    Session session{device};
    REQUIRE(session.run() == PHASETREE_ERROR_NONE);
    REQUIRE(session.geometry != nullptr);
    session.release();
    const std::ptrdiff_t before = used;
    faults::fail_allocation(~std::size_t{0}, false);
    CHECK(session.run() == PHASETREE_ERROR_NONE);
    const std::size_t count = faults::stop_failing_allocations();
    session.release();
    CHECK(count > 300);

    int failed = 0;
    for (std::size_t n = 1; n <= count; n = next(n))
        for (const bool for_good : {false, true}) {
            CAPTURE(n);
            CAPTURE(for_good);
            faults::fail_allocation(n, for_good);
            const PhasetreeError other = session.run();
            const bool is_message_there = phasetreeGetErrorMessage() != nullptr;
            faults::stop_failing_allocations();
            CHECK(other == PHASETREE_ERROR_NONE);
            CHECK(is_message_there);
            failed += !session.tree || !session.edited || !session.geometry;
            session.release();
            CHECK(used == before);
        }
    CHECK(failed > 50);
    MESSAGE(count << " allocations, " << failed << " runs without a tree or a geometry");
    rtcReleaseDevice(device);
}

TEST_CASE("a thread that traces for the first time has no memory") {
    // Many bumps meet in a cell, so its program is long.
    std::string bumps;
    for (int i = 0; i < 80; ++i)
        bumps += std::string(i == 0 ? "" : ",") + R"({"translate": {"by": [)" + std::to_string(0.001 * i) +
                 R"(, 0, 0], "of": {"torus": {"major": 0.5, "minor": )" + std::to_string(0.1 + 0.001 * i) + "}}}}";
    const std::string many =
        R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"smooth_union": {"radius": 0.2, "of": [)" +
        bumps + "]}}}}}";
    const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    PhasetreeTree tree = nullptr;
    PhasetreeGeometry geometry = nullptr;
    RTCGeometry embree = nullptr;
    const auto made =
        phasetreeNewTreeFromText(PHASETREE_API_VERSION, many.data(), many.size(), nullptr, nullptr, &tree);
    CAPTURE(phasetreeGetErrorMessage());
    REQUIRE(made == PHASETREE_ERROR_NONE);
    PhasetreeGeometryOptions options;
    phasetreeInitGeometryOptions(&options);
    options.cellDivisions = 2;
    REQUIRE(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree, &options, &geometry) == PHASETREE_ERROR_NONE);
    PhasetreeGeometryStatistics statistics;
    REQUIRE(phasetreeGetGeometryStatistics(geometry, &statistics) == PHASETREE_ERROR_NONE);
    REQUIRE(statistics.maxInstructions > 100);
    REQUIRE(phasetreeGetEmbreeGeometry(geometry, &embree) == PHASETREE_ERROR_NONE);
    const RTCScene scene = rtcNewScene(device);
    rtcCommitGeometry(embree);
    rtcAttachGeometry(scene, embree);
    rtcCommitScene(scene);
    std::size_t asked = 0;
    float far = 0;
    unsigned hit = RTC_INVALID_GEOMETRY_ID;
    std::thread([&] {
        PhasetreeRayContext context;
        phasetreeInitRayContext(&context);
        RTCRayHit ray = embree::rayhit_of({0.5f, 0, 5}, {0, 0, -1});
        faults::fail_allocation(1, true);
#if RTC_VERSION_MAJOR >= 4
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.context = &context.context;
        rtcIntersect1(scene, &ray, &arguments);
#else
        rtcIntersect1(scene, &context.context, &ray);
#endif
        asked = faults::stop_failing_allocations();
        far = ray.ray.tfar;
        hit = ray.hit.geomID;
    }).join();
    // A ray cannot report failure: it hits what it should, or nothing.
    CHECK(asked > 0);
    CHECK((hit == RTC_INVALID_GEOMETRY_ID ? far > 1e30f : far < 5));
    MESSAGE(asked << " allocations by a ray");
    rtcReleaseScene(scene);
    CHECK(phasetreeReleaseGeometry(geometry) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeReleaseTree(tree) == PHASETREE_ERROR_NONE);
    rtcReleaseDevice(device);
}

}  // namespace test_interface
