// A scene prepared for rays.
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
    /// Shares ownership of the scene. Its owner may still change the camera, the film and the number of samples, which
    /// are not read here. Throws as World does.
    Prepared(std::shared_ptr<const Scene> scene, const WorldOptions& options);

    const Scene& scene() const { return *scene_; }
    const World& world() const { return world_; }
    /// Whether it was built for a first look (WorldOptions::is_first_look).
    bool is_first_look() const { return is_first_look_; }
    /// Traces through opaque phases too. Created on first use; pictures do not need it. Throws ModelError.
    const InterfaceTracer& tracer() const;

  private:
    std::shared_ptr<const Scene> scene_;
    bool is_first_look_;
    World world_;
    mutable std::once_flag once_;
    mutable std::optional<InterfaceTracer> tracer_;
};

}  // namespace phasetree::tracer::view
