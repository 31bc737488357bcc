// Misuse is an error code with a message that says what is wrong, and never a crash.
#include "embree/api/api.hpp"

namespace test_misuse {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

void expect(PhasetreeError error, PhasetreeError expected, const char* part) {
    CHECK(error == expected);
    const std::string message = phasetreeGetErrorMessage();
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("wrong versions") {
    CHECK(phasetreeGetApiVersion() == PHASETREE_API_VERSION);
    PhasetreeTree tree = nullptr;
    const unsigned other = 100 * PHASETREE_API_NUMBER + (7 - RTC_VERSION_MAJOR);
    expect(phasetreeNewTreeFromText(other, object_text, std::strlen(object_text), nullptr, nullptr, &tree),
           PHASETREE_ERROR_VERSION, "is linked with the library for Embree");
    expect(phasetreeNewTreeFromFile(PHASETREE_API_VERSION + 100, "x", nullptr, &tree), PHASETREE_ERROR_VERSION,
           "pass PHASETREE_API_VERSION");
    CHECK(tree == nullptr);
    Device device;
    PhasetreeGeometry geometry = nullptr;
    expect(phasetreeNewGeometry(0, device, object_tree().get(), nullptr, &geometry), PHASETREE_ERROR_VERSION,
           "apiVersion is 0");
    CHECK(geometry == nullptr);
}

TEST_CASE("null, freed and foreign handles") {
    const auto invalid = PHASETREE_ERROR_INVALID_HANDLE;
    PhasetreeTree tree = nullptr, edited = nullptr;
    REQUIRE(phasetreeNewTreeFromText(PHASETREE_API_VERSION, object_text, std::strlen(object_text), "object", nullptr,
                                     &tree) == PHASETREE_ERROR_NONE);
    REQUIRE(phasetreeRetainTree(tree) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeReleaseTree(tree) == PHASETREE_ERROR_NONE);
    unsigned count = 0;
    CHECK(phasetreeGetTreePhaseCount(tree, &count) == PHASETREE_ERROR_NONE);
    CHECK(count == 5);
    CHECK(phasetreeReleaseTree(tree) == PHASETREE_ERROR_NONE);
    // Now it is gone; another one does not revive it.
    const embree::Tree next = object_tree();
    int number = 0;
    for (const auto bad : {static_cast<PhasetreeTree>(nullptr), tree, reinterpret_cast<PhasetreeTree>(&number),
                           reinterpret_cast<PhasetreeTree>(~std::uintptr_t{0}), reinterpret_cast<PhasetreeTree>(1)}) {
        CAPTURE(bad);
        expect(phasetreeReleaseTree(bad), invalid, "tree");
        expect(phasetreeRetainTree(bad), invalid, "tree");
        expect(phasetreeGetTreePhaseCount(bad, &count), invalid, "tree");
        expect(phasetreeNewEditedTree(bad, "", "1", &edited), invalid, "tree");
        CHECK(edited == nullptr);
    }
    CHECK(next.phase_count() == 5);

    Device device;
    PhasetreeGeometry geometry = nullptr;
    expect(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree, nullptr, &geometry), invalid,
           "already been released");
    CHECK(geometry == nullptr);
    REQUIRE(phasetreeNewGeometry(PHASETREE_API_VERSION, device, next.get(), nullptr, &geometry) ==
            PHASETREE_ERROR_NONE);
    const auto freed = geometry;
    CHECK(phasetreeReleaseGeometry(geometry) == PHASETREE_ERROR_NONE);
    void* pointer = nullptr;
    RTCGeometry embree_geometry = nullptr;
    PhasetreeHit hit;
    PhasetreeClosest closest;
    PhasetreeGeometryStatistics statistics;
    const char* warning = nullptr;
    const RTCRayHit ray{};
    const float p[3] = {0, 0, 0};
    float phi[PHASETREE_MAX_PHASES];
    for (const auto bad :
         {static_cast<PhasetreeGeometry>(nullptr), freed, reinterpret_cast<PhasetreeGeometry>(&number),
          reinterpret_cast<PhasetreeGeometry>(next.get()), reinterpret_cast<PhasetreeGeometry>(~std::uintptr_t{0})}) {
        CAPTURE(bad);
        expect(phasetreeReleaseGeometry(bad), invalid, "geometry");
        expect(phasetreeRetainGeometry(bad), invalid, "geometry");
        expect(phasetreeGetEmbreeGeometry(bad, &embree_geometry), invalid, "geometry");
        expect(phasetreeSetGeometryUserData(bad, nullptr), invalid, "geometry");
        expect(phasetreeGetGeometryUserData(bad, &pointer), invalid, "geometry");
        expect(phasetreeSetGeometryTree(bad, next.get(), nullptr), invalid, "geometry");
        expect(phasetreeSetGeometryShownPhases(bad, 1), invalid, "geometry");
        expect(phasetreeSetGeometryMotion(bad, nullptr, 0, 0, 1), invalid, "geometry");
        expect(phasetreeGetGeometryStatistics(bad, &statistics), invalid, "geometry");
        expect(phasetreeGetGeometryWarning(bad, &warning), invalid, "geometry");
        expect(phasetreeDecodeHit(bad, &ray, nullptr, &hit), invalid, "geometry");
        expect(phasetreeGetPhase(bad, p, 0, &count, nullptr), invalid, "geometry");
        expect(phasetreeGetDistances(bad, p, 0, phi), invalid, "geometry");
        expect(phasetreeFindClosestInterface(bad, p, 0, 1, 0.01f, &closest), invalid, "geometry");
        // Nor do callbacks follow it.
        RTCBounds box;
        RTCBoundsFunctionArguments args{};
        args.bounds_o = &box;
        phasetreeGetPrimitiveBounds(bad, &args);
        CHECK(box.lower_x > box.upper_x);
        RTCIntersectFunctionNArguments query{};
        query.N = 1;
        phasetreeIntersectPrimitive(bad, &query);
    }
}

TEST_CASE("handles freed and made again many times are never the same") {
    std::vector<PhasetreeTree> all;
    const char* const text =
        R"({"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})";
    for (int i = 0; i < 5000; ++i) {
        PhasetreeTree tree = nullptr;
        REQUIRE(phasetreeNewTreeFromText(PHASETREE_API_VERSION, text, std::strlen(text), nullptr, nullptr, &tree) ==
                PHASETREE_ERROR_NONE);
        all.push_back(tree);
        REQUIRE(phasetreeReleaseTree(tree) == PHASETREE_ERROR_NONE);
    }
    for (const PhasetreeTree tree : all) REQUIRE(phasetreeReleaseTree(tree) == PHASETREE_ERROR_INVALID_HANDLE);
    std::sort(all.begin(), all.end());
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("arguments that are missing or impossible") {
    const auto invalid = PHASETREE_ERROR_INVALID_ARGUMENT;
    const unsigned v = PHASETREE_API_VERSION;
    PhasetreeTree tree = nullptr;
    expect(phasetreeNewTreeFromFile(v, nullptr, nullptr, &tree), invalid, "path is NULL");
    expect(phasetreeNewTreeFromFile(v, "x", nullptr, nullptr), invalid, "tree is NULL");
    expect(phasetreeNewTreeFromText(v, nullptr, 3, nullptr, nullptr, &tree), invalid, "text is NULL");
    expect(phasetreeNewTreeFromText(v, "{}", 2, nullptr, nullptr, &tree), PHASETREE_ERROR_INVALID_TREE, "phases");
    CHECK(tree == nullptr);
    const embree::Tree object = object_tree();
    const char* name = nullptr;
    unsigned phase = 99;
    expect(phasetreeGetTreePhaseCount(object.get(), nullptr), invalid, "count");
    expect(phasetreeGetTreePhaseName(object.get(), 5, &name), invalid, "phase 5 does not exist");
    expect(phasetreeGetTreePhaseByName(object.get(), "gold", &phase), invalid, "\"gold\"");
    expect(phasetreeGetTreeBounds(object.get(), nullptr), invalid, "bounds");
    expect(phasetreeNewEditedTree(object.get(), nullptr, "1", &tree), invalid, "path");
    expect(phasetreeNewEditedTree(object.get(), "", nullptr, &tree), invalid, "value");
    CHECK(phase == 99);

    Device device;
    PhasetreeGeometry geometry = nullptr;
    expect(phasetreeNewGeometry(v, nullptr, object.get(), nullptr, &geometry), invalid, "device");
    expect(phasetreeNewGeometry(v, device, object.get(), nullptr, nullptr), invalid, "geometry");
    PhasetreeGeometryOptions options = embree::default_options();
    for (const float bad : {-1.0f, infinity, std::numeric_limits<float>::quiet_NaN()}) {
        options.resolution = bad;
        expect(phasetreeNewGeometry(v, device, object.get(), &options, &geometry), invalid, "resolution");
    }
    options = embree::default_options();
    options.flags = 1u << 20;
    expect(phasetreeNewGeometry(v, device, object.get(), &options, &geometry), invalid, "flags");
    options = embree::default_options();
    for (const unsigned bad : {unsigned{RTC_BUILD_QUALITY_REFIT}, 77u}) {
        options.buildQuality = bad;
        expect(phasetreeNewGeometry(v, device, object.get(), &options, &geometry), invalid, "buildQuality");
    }
    options = embree::default_options();
    options.cellDivisions = 1000;
    expect(phasetreeNewGeometry(v, device, object.get(), &options, &geometry), invalid, "cellDivisions");
    options = embree::default_options();
    options.opaquePhases = 0b1001;
    expect(phasetreeNewGeometry(v, device, object.get(), &options, &geometry), invalid, "vacuum");
    options.opaquePhases = 0b1000;
    options.shownPhases = 0b0110;
    expect(phasetreeNewGeometry(v, device, object.get(), &options, &geometry), invalid, "phase 3 is opaque");
    CHECK(geometry == nullptr);

    options.shownPhases = PHASETREE_ALL_PHASES;
    const Placed opaque(object, options);
    expect(phasetreeSetGeometryShownPhases(opaque.geometry.get(), 0b0110), invalid, "phase 3 is opaque");
    expect(phasetreeSetGeometryShownPhases(opaque.geometry.get(), 0b1000), PHASETREE_ERROR_NONE, "");

    Placed placed(object);
    const PhasetreeGeometry g = placed.geometry.get();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float p[3] = {0, 0, 0}, bad_point[3] = {0, nan, 0};
    PhasetreeClosest closest;
    expect(phasetreeGetPhase(g, bad_point, 0, &phase, nullptr), invalid, "finite");
    expect(phasetreeGetPhase(g, nullptr, 0, &phase, nullptr), invalid, "point");
    expect(phasetreeGetPhase(g, p, 0, nullptr, nullptr), invalid, "phase");
    expect(phasetreeFindClosestInterface(g, p, 0, -1, 0.1f, &closest), invalid, "radius");
    expect(phasetreeFindClosestInterface(g, p, 0, nan, 0.1f, &closest), invalid, "radius");
    expect(phasetreeFindClosestInterface(g, p, 0, 1, 0, &closest), invalid, "tolerance");
    const float singular[12] = {1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0}, odd[12] = {nan, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    const float one[24] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    expect(phasetreeSetGeometryMotion(g, nullptr, 2, 0, 1), invalid, "transforms");
    expect(phasetreeSetGeometryMotion(g, singular, 1, 0, 1), invalid, "no inverse");
    expect(phasetreeSetGeometryMotion(g, odd, 1, 0, 1), invalid, "finite");
    expect(phasetreeSetGeometryMotion(g, one, 2, 1, 1), invalid, "startTime");
    expect(phasetreeSetGeometryMotion(g, one, 1000, 0, 1), invalid, "timeStepCount");
    // Embree would stop the program, or never be done.
    const float outside[][2] = {{1, 2},      {-1, 0},      {5.0f / 3, 28.0f / 15},
                                {-3, -2.9f}, {-5, 1e-10f}, {0.99999994f, 1.5f}};
    for (const auto& times : outside)
        expect(phasetreeSetGeometryMotion(g, one, 2, times[0], times[1]), invalid, "shutter");
    // What is met for a moment alone is built.
    const float inside[][2] = {{0.9999f, 1.5f}, {-1, 1e-3f}, {-1e5f, 1e5f}, {0.5f, 0.5000001f}, {0, 1e-10f}};
    for (const auto& times : inside) {
        REQUIRE(phasetreeSetGeometryMotion(g, one, 2, times[0], times[1]) == PHASETREE_ERROR_NONE);
        rtcCommitGeometry(placed.geometry.embree());
        placed.scene.commit();
    }
}

TEST_CASE("hits that are none, or another geometry's") {
    const Placed placed;
    const PhasetreeGeometry g = placed.geometry.get();
    const auto not_now = PHASETREE_ERROR_INVALID_OPERATION;
    const RTCRayHit miss = trace_one(placed.scene, rayhit({{0, -3, 0}, {0, -1, 0}}));
    const RTCRayHit good = trace_one(placed.scene, rayhit({{0, -3, 0}, {0, 1, 0}}));
    REQUIRE(hits(good));
    PhasetreeHit hit{};
    expect(phasetreeDecodeHit(g, &miss, nullptr, &hit), not_now, "hit nothing");
    expect(phasetreeDecodeHit(g, nullptr, nullptr, &hit), PHASETREE_ERROR_INVALID_ARGUMENT, "rayhit");
    expect(phasetreeDecodeHit(g, &good, nullptr, nullptr), PHASETREE_ERROR_INVALID_ARGUMENT, "hit");
    RTCRayHit other = good;
    other.hit.u = 0.3f;
    expect(phasetreeDecodeHit(g, &other, nullptr, &hit), not_now, "u is 0.3");
    other = good;
    other.hit.v = std::numeric_limits<float>::quiet_NaN();
    expect(phasetreeDecodeHit(g, &other, nullptr, &hit), not_now, "is not a phase");
    other = good;
    other.hit.primID = 1u << 30;
    expect(phasetreeDecodeHit(g, &other, nullptr, &hit), not_now, "primID");
    other = good;
    other.hit.instID[0] = 0;
    expect(phasetreeDecodeHit(g, &other, nullptr, &hit), PHASETREE_ERROR_INVALID_ARGUMENT, "objectToWorld");
    other = good;
    other.ray.tfar = infinity;
    expect(phasetreeDecodeHit(g, &other, nullptr, &hit), not_now, "is not a valid ray");
    CHECK(phasetreeDecodeHit(g, &good, nullptr, &hit) == PHASETREE_ERROR_NONE);
    CHECK(hit.to == static_cast<unsigned>(good.hit.v));
}

TEST_CASE("Embree geometries that are not ours") {
    Device device;
    const RTCGeometry foreign = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    PhasetreeGeometry found = nullptr;
    expect(phasetreeGetGeometryFromEmbree(foreign, &found), PHASETREE_ERROR_INVALID_HANDLE,
           "not created by this library");
    const embree::Geometry mine(device, object_tree());
    // Another one that points to our handle is not ours either.
    rtcSetGeometryUserData(foreign, mine.get());
    CHECK(phasetreeGetGeometryFromEmbree(foreign, &found) == PHASETREE_ERROR_INVALID_HANDLE);
    CHECK(phasetreeGetGeometryFromEmbree(nullptr, &found) == PHASETREE_ERROR_INVALID_ARGUMENT);
    CHECK(found == nullptr);
    CHECK(phasetreeGetGeometryFromEmbree(mine.embree(), &found) == PHASETREE_ERROR_NONE);
    CHECK(found == mine.get());
    rtcReleaseGeometry(foreign);
}

TEST_CASE("the application's pointer is its own") {
    Device device;
    embree::Geometry geometry(device, object_tree());
    CHECK(geometry.user_data() == nullptr);
    int mine = 0;
    geometry.set_user_data(&mine);
    CHECK(geometry.user_data() == &mine);
    geometry.set_tree(object_tree());
    CHECK(geometry.user_data() == &mine);
    geometry.set_user_data(nullptr);
    CHECK(geometry.user_data() == nullptr);
}

TEST_CASE("any order of releasing") {
    const RTCDevice device = rtcNewDevice(nullptr);
    PhasetreeTree tree = nullptr;
    PhasetreeGeometry geometry = nullptr;
    REQUIRE(phasetreeNewTreeFromText(PHASETREE_API_VERSION, object_text, std::strlen(object_text), nullptr, nullptr,
                                     &tree) == PHASETREE_ERROR_NONE);
    REQUIRE(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree, nullptr, &geometry) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeReleaseTree(tree) == PHASETREE_ERROR_NONE);
    RTCGeometry handle = nullptr;
    REQUIRE(phasetreeGetEmbreeGeometry(geometry, &handle) == PHASETREE_ERROR_NONE);
    const RTCScene scene = rtcNewScene(device);
    rtcCommitGeometry(handle);
    rtcAttachGeometry(scene, handle);
    rtcCommitScene(scene);
    // A scene of Embree 4 (4.4.1) that is the last to hold its device frees it too early: one box of anybody's crashes.
    constexpr bool is_device_first = PHASETREE_EMBREE_MAJOR == 3;
    if (is_device_first) rtcReleaseDevice(device);
    CHECK(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
    CHECK(phasetreeReleaseGeometry(geometry) == PHASETREE_ERROR_NONE);
    CHECK_FALSE(hits(trace_one(scene, rayhit({{0, -3, 0}, {0, 1, 0}}))));
    rtcReleaseScene(scene);
    if (!is_device_first) rtcReleaseDevice(device);
}

}  // namespace test_misuse
