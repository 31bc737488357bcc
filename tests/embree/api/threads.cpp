// Many threads: tracing one scene, making and editing trees and geometries of their own, and scenes that change between
// traces. Meant for ThreadSanitizer and AddressSanitizer, and sound without.
#include <atomic>
#include <thread>

#include "embree/api/api.hpp"

namespace test_threads {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr int thread_count = 4;

template <class F>
void on_threads(F&& f) {
    std::vector<std::thread> threads;
    for (int i = 0; i < thread_count; ++i) threads.emplace_back([&f, i] { f(i); });
    for (std::thread& t : threads) t.join();
}

const char* const ball_text = R"({"phases": {"a": 0, "b": 0}, "tree": {"under": [
    {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}, {"set": {"phase": "b", "of": {"sphere": {"radius": 0.5}}}}]}})";

// Doctest's checks are not for threads: what went wrong is counted.
int differing(RTCScene scene, const std::vector<RTCRayHit>& before, const std::vector<RTCRayHit>& expected) {
    int wrong = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!same_bits(trace_one(scene, before[i]), expected[i])) ++wrong;
        if (occluded_one(scene, before[i]) != hits(expected[i])) ++wrong;
    }
    return wrong;
}

}  // namespace

TEST_CASE("a scene that many threads trace, changed between") {
    Device device;
    embree::Geometry object(device, object_tree()), other(device, embree::Tree::from_text(ball_text));
    std::vector<RTCRayHit> before;
    for (const Ray& ray : rays(400, 81)) before.push_back(marked(ray));
    const RTCScene scene = new_scene(device, RTC_SCENE_FLAG_DYNAMIC);
    const unsigned object_id = 0, other_id = 1;
    rtcCommitGeometry(object.embree());
    rtcCommitGeometry(other.embree());
    rtcAttachGeometryByID(scene, object.embree(), object_id);
    rtcAttachGeometryByID(scene, other.embree(), other_id);
    const embree::Tree tree = embree::Tree::from_text(ball_text);
    std::mt19937 random(82);
    for (int round = 0; round < 12; ++round) {
        switch (round % 6) {
            case 0:
                rtcDisableGeometry(object.embree());
                break;
            case 1:
                rtcEnableGeometry(object.embree());
                break;
            case 2:
                rtcDetachGeometry(scene, other_id);
                break;
            case 3:
                rtcAttachGeometryByID(scene, other.embree(), other_id);
                break;
            case 4:
                other.set_tree(tree.edited("/tree/under/0/set/of/sphere/radius", round == 4 ? "1.2" : "0.8"));
                break;
            default:
                other.set_motion({{1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1f * static_cast<float>(round), 0, 0}});
                break;
        }
        rtcCommitGeometry(object.embree());
        rtcCommitGeometry(other.embree());
        rtcCommitScene(scene);
        std::vector<RTCRayHit> expected;
        for (const RTCRayHit& ray : before) expected.push_back(trace_one(scene, ray));
        std::atomic<int> wrong{0};
        on_threads([&](int) { wrong += differing(scene, before, expected); });
        CHECK(wrong == 0);
    }
    rtcReleaseScene(scene);
}

TEST_CASE("threads that make, edit, trace and release their own, and share trees and handles") {
    Device device;
    const embree::Tree shared_tree = embree::Tree::from_text(ball_text);
    const embree::Geometry shared(device, shared_tree);
    EmbreeScene scene(device);
    scene.add(shared.embree());
    scene.commit();
    std::atomic<int> wrong{0};
    on_threads([&](int thread) {
        for (int i = 0; i < 20; ++i) {
            try {
                const embree::Tree edited =
                    shared_tree.edited("/tree/under/0/set/of/sphere/radius", std::to_string(1.0 + 0.1 * thread));
                const embree::Geometry own(device, edited);
                const embree::Geometry copy = shared;
                EmbreeScene mine(device);
                mine.add(own.embree());
                mine.commit();
                const RTCRayHit r = trace_one(mine, rayhit({{-3, 0.01f, 0}, {1, 0, 0}}));
                const float expected = 3 - (1 + 0.1f * static_cast<float>(thread));
                if (!hits(r) || std::abs(r.ray.tfar - expected) > 1e-3f) ++wrong;
                if (!hits(trace_one(scene, rayhit({{-3, 0.01f, 0}, {1, 0, 0}})))) ++wrong;
                if (copy.phase({0.7f, 0, 0}) != 1 || own.phase({0, 0, 0}) != 2) ++wrong;
                if (own.closest({0.7f, 0, 0}, infinity).to == 1) ++wrong;
                // An error of this thread's own.
                if (phasetreeReleaseTree(nullptr) != PHASETREE_ERROR_INVALID_HANDLE) ++wrong;
            } catch (const embree::Error&) {
                ++wrong;
            }
        }
    });
    CHECK(wrong == 0);
}

TEST_CASE("error messages are each thread's own") {
    std::atomic<int> wrong{0};
    on_threads([&](int thread) {
        for (int i = 0; i < 200; ++i) {
            const std::string path = "/nowhere/" + std::to_string(thread) + ".json";
            PhasetreeTree tree = nullptr;
            if (phasetreeNewTreeFromFile(PHASETREE_API_VERSION, path.c_str(), nullptr, &tree) !=
                PHASETREE_ERROR_INVALID_TREE)
                ++wrong;
            if (std::string(phasetreeGetErrorMessage()).find(path) == std::string::npos) ++wrong;
        }
    });
    CHECK(wrong == 0);
}

}  // namespace test_threads
