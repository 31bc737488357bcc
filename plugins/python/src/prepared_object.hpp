// An object prepared for rays: its cells in Embree.
#pragma once

#include <memory>

#include "embree_core/cell_scene.hpp"

namespace phasetree::python {

class PreparedObject {
  public:
    /// Throws ModelError for an object that cannot be traced, and BuildCancelled.
    PreparedObject(const Phased& object, const CellOptions& options);

    const embree::CellScene& scene() const { return *scene_; }
    const InterfaceCells& cells() const { return scene_->cells(); }

  private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    };
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;  // behind the scene when it ends
    std::unique_ptr<const embree::CellScene> scene_;
};

}  // namespace phasetree::python
