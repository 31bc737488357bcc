// The scene in Embree: the object as user geometry, the meshes beside it, and the optics of all their surfaces.
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include "embree_core/cell_geometry.hpp"
#include "scene/scene.hpp"
#include "shading/interface.hpp"
#include "world/counters.hpp"
#include "world/hit.hpp"
#include "world/ray.hpp"
#include "world/world_options.hpp"

namespace phasetree::tracer {

class TracedGeometry {
  public:
    /// Refers to the scene, which must outlive it. Throws ModelError for an object that cannot be traced, and
    /// BuildCancelled once WorldOptions::cancelled says so.
    explicit TracedGeometry(const Scene& scene, const WorldOptions& = {});

    /// What a ray meets first.
    Hit intersect(const Ray& ray, PathCounters& counters) const;
    /// What stands first in the way of light along a ray, before the distance `far`.
    Visibility visibility(const Ray& ray, float far, PathCounters& counters) const;

    /// The phase at a point.
    Phase label(const glm::vec3& p) const;
    const InterfaceCells& object() const { return *object_; }

  private:
    /// `shared` is used while the interfaces are made.
    TracedGeometry(const Scene& scene, const WorldOptions& options, SharedSurfaces&& shared);

    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
    using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

    static DeviceHandle start_embree();
    static SceneHandle embree_scene(RTCDevice device, const embree::CellGeometry& tree,
                                    const std::vector<Mesh>& meshes);

    bool trace(const Ray& ray, float far, embree::Query& query, RTCRayHit& hit, PathCounters& counters) const;
    Surface surface_of_object(const Ray& ray, const embree::Query& query, const RTCRayHit& hit) const;
    Surface surface_of_mesh(const Ray& ray, const RTCRayHit& hit) const;

    const Scene& scene_;
    std::shared_ptr<const InterfaceCells> object_;
    DeviceHandle device_;
    embree::CellGeometry tree_;
    SceneHandle embree_;
    InterfaceTable interfaces_;
    std::vector<Interface> mesh_interfaces_;  ///< [mesh · phases + phase the ray is in]
    float surface_epsilon_;                   ///< least distance by which rays that leave a mesh are moved off it
};

}  // namespace phasetree::tracer
