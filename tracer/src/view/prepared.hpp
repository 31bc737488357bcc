// A scene that is ready for rays.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "phasetree/trace/tracer.hpp"
#include "scene/scene.hpp"
#include "world/world.hpp"

namespace phasetree::tracer::view {

class Prepared {
  public:
    /// Shares the scene, whose camera, film and number of samples its owner may go on to change: nothing here reads
    /// them. Throws as World does.
    Prepared(std::shared_ptr<const Scene> scene, const WorldOptions& options);

    const Scene& scene() const { return *scene_; }
    const World& world() const { return world_; }
    /// Whether it is for a first look (WorldOptions::is_first_look).
    bool is_first_look() const { return is_first_look_; }
    /// Traces through opaque phases, too. It is made when it is first asked for, which no picture does. Throws
    /// ModelError.
    const InterfaceTracer& tracer() const;

  private:
    std::shared_ptr<const Scene> scene_;
    bool is_first_look_;
    World world_;
    mutable std::once_flag once_;
    mutable std::optional<InterfaceTracer> tracer_;
};

}  // namespace phasetree::tracer::view
