#pragma once

#include <atomic>
#include <mutex>

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// The object of a geometry in the C99 interface: its cells, and a scene that contains them. Thread-safe.
class Object {
  public:
    /// When the scene of the cells is built: immediately, or on first use.
    enum class SceneWithin { at_once, when_asked };

    /// Throws EmbreeError.
    Object(RTCDevice device, std::shared_ptr<const InterfaceCells> cells, SceneWithin);
    ~Object();

    const InterfaceCells& cells() const { return *cells_; }
    /// Throws EmbreeError if the scene must be built and this fails.
    const CellScene& scene() const {
        const CellScene* scene = scene_.load(std::memory_order_acquire);
        return scene ? *scene : build();
    }

  private:
    const CellScene& build() const;

    RTCDevice device_;  ///< the geometry's, which keeps it alive
    std::shared_ptr<const InterfaceCells> cells_;
    mutable std::mutex building_;
    mutable std::unique_ptr<const CellScene> owned_;
    mutable std::atomic<const CellScene*> scene_ = nullptr;
};

}  // namespace phasetree::embree
