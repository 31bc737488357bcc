#include "trace/embree_scene.hpp"

#include <stdexcept>

namespace phasetree::bench {

namespace {

bool count_bytes(void* counter, ssize_t bytes, bool /*after*/) noexcept {
    static_cast<std::atomic<std::ptrdiff_t>*>(counter)->fetch_add(bytes);
    return true;
}

}  // namespace

EmbreeScene::EmbreeScene(RTCSceneFlags flags) : bytes_(std::make_unique<std::atomic<std::ptrdiff_t>>(0)) {
    device_ = rtcNewDevice(nullptr);
    if (!device_) throw std::runtime_error("Embree cannot be started");
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, bytes_.get());
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, flags);
}

EmbreeScene::~EmbreeScene() {
    // A geometry may outlive the scene, and keeps the device; the counter does not.
    rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

}  // namespace phasetree::bench
