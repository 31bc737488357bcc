#pragma once

#include <atomic>
#include <mutex>

#include "embree_core/cell_scene.hpp"

namespace phasetree::embree {

/// An object as a geometry of the C99 interface has it: its cells, and a scene of them within. Any thread may ask.
class Object {
  public:
    /// When the scene of the cells is built: at once, or when somebody asks for it.
    enum class SceneWithin { at_once, when_asked };

    /// Throws EmbreeError.
    Object(RTCDevice device, std::shared_ptr<const InterfaceCells> cells, SceneWithin);
    ~Object();

    const InterfaceCells& cells() const { return *cells_; }
    /// Throws EmbreeError if it is built now and cannot be.
    const CellScene& scene() const {
        const CellScene* scene = scene_.load(std::memory_order_acquire);
        return scene ? *scene : build();
    }

  private:
    const CellScene& build() const;

    RTCDevice device_;  ///< the geometry's, which holds it
    std::shared_ptr<const InterfaceCells> cells_;
    mutable std::mutex building_;
    mutable std::unique_ptr<const CellScene> owned_;
    mutable std::atomic<const CellScene*> scene_ = nullptr;
};

}  // namespace phasetree::embree
