#pragma once

#include <memory>
#include <type_traits>

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// An object prepared for tracing, with its own device. Use it to trace rays without rendering. Immutable; any thread
/// may trace.
class PreparedObject {
  public:
    /// Throws ModelError if the object cannot be traced, BuildCancelled, and EmbreeError.
    PreparedObject(const Phased& object, const CellOptions& options);

    const CellScene& scene() const { return *scene_; }
    const InterfaceCells& cells() const { return scene_->cells(); }

  private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    };
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>
        device_;  // first member, so that it is destroyed after the scene
    std::unique_ptr<const CellScene> scene_;
};

}  // namespace phasetree::embree
