// An Embree scene of one geometry, and the bytes that Embree takes for it.
#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "embree_core/embree.hpp"
#include "measure/checksum.hpp"
#include "rays/ray.hpp"

namespace phasetree::bench {

// A device of its own, so that what it takes in memory is this scene's.
class EmbreeScene {
  public:
    explicit EmbreeScene(RTCSceneFlags flags);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCDevice device() const { return device_; }
    RTCScene handle() const { return scene_; }
    // Embree's hierarchy, and the buffers that it made itself.
    std::size_t bytes() const { return static_cast<std::size_t>(bytes_->load()); }

  private:
    std::unique_ptr<std::atomic<std::ptrdiff_t>> bytes_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace phasetree::bench
