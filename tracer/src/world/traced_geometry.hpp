// The scene in Embree: the object as user geometry, or instances of several, the meshes, and the optics of all
// surfaces.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "embree_core/cell_geometry.hpp"
#include "media/contract.hpp"
#include "scene/scene.hpp"
#include "shading/interface.hpp"
#include "world/counters.hpp"
#include "world/hit.hpp"
#include "world/moving_mesh.hpp"
#include "world/placed_geometry.hpp"
#include "world/ray.hpp"
#include "world/world_options.hpp"

namespace phasetree::tracer {

/// The options for building the cells of a scene's objects.
CellOptions cell_options(const Scene&, const WorldOptions&);

class TracedGeometry {
  public:
    /// Refers to the scene, which must outlive it. Throws ModelError if an object cannot be traced, and BuildCancelled
    /// when WorldOptions::cancelled returns true.
    explicit TracedGeometry(const Scene& scene, const WorldOptions& = {});

    /// The closest hit of a ray.
    Hit intersect(const Ray& ray, PathCounters& counters) const;
    /// The first occluder of light along a ray, before the distance `far`.
    Visibility visibility(const Ray& ray, float far, PathCounters& counters) const;

    /// The segment of a ray in the medium of its phase. If the medium's density varies, the segment is in the space of
    /// the first object that contains the ray. Its direction does not have unit length there, so that lengths are those
    /// of the scene.
    Way way_through_medium(const Ray& ray, float length, const Wavelengths* wavelengths = nullptr) const;

    /// The phase at a point, at a share of the shutter interval.
    Phase label(const glm::vec3& p, float time = 0) const { return inside(p, time).phase; }
    /// The phase at a point and, in a scene with several objects, those that contain it: the values for a ray that
    /// starts there.
    struct Inside {
        Phase phase{};
        RayObjects in{};
    };
    Inside inside(const glm::vec3& p, float time = 0) const;

    /// The object of a scene with one tree.
    const InterfaceCells& object() const { return *cells_.front(); }
    /// Every object, in the order of PlacedObjects::objects.
    const std::vector<std::shared_ptr<const InterfaceCells>>& objects() const { return cells_; }
    /// The sums over all objects; for numbers per cell, the maximum.
    CellStatistics statistics() const;
    /// A box around all objects.
    const Bounds& bounds() const { return placed_ ? placed_->bounds() : object().bounds(); }

  private:
    TracedGeometry(const Scene& scene, const WorldOptions& options, const std::shared_ptr<SharedSurfaces>& shared);

    /// A change of phase in one of several objects, in scene space.
    struct CrossingInScene {
        Crossing crossing;  ///< in object space
        Copy copy;
        StartHint hint;
        double distance = 0;            ///< along the ray
        glm::vec3 p_from{0}, p_to{0};   ///< the ends of the bracket
        glm::vec3 normal{0};            ///< unit length, on the side from which the ray comes
        glm::vec3 normal_in_object{0};  ///< the same in object space
        double tolerance = 0;           ///< PlacedGeometry::tolerance
    };
    /// One crossing, or two within their tolerances.
    struct Met {
        CrossingInScene first;
        std::optional<CrossingInScene> joined;  ///< set if another object starts where the first ends
        RayObjects behind;

        double apart() const { return joined ? first.tolerance + joined->tolerance : 0.0; }
    };
    using NextOfSeveral = std::variant<Escaped, RTCRayHit, CrossingInScene>;

    /// The ray in Embree, at its time.
    static RTCRayHit rayhit_of(const Ray& ray, float near, float far);
    /// Find the closest hit with Embree. The distance, coordinates and normal of a hit on a mesh are recomputed, so
    /// that they do not depend on the processor.
    void find_closest_hit(embree::Query&, RTCRayHit&) const;
    bool trace(const Ray& ray, float far, embree::Query& query, RTCRayHit& hit, PathCounters& counters) const;
    /// The mesh that is flush with an interface, if there is one and light continues behind the interface, in the phase
    /// `to`. The interface is between the points p_from, which is `distance` from the ray's origin, and p_to. The ray
    /// would continue from p_to and could start behind the mesh, so a mesh between the two counts as in front of the
    /// interface.
    std::optional<RTCRayHit> mesh_flush_with_interface(const Ray& ray, Phase to, float distance,
                                                       const glm::vec3& p_from, const glm::vec3& p_to) const;
    Surface surface_of_object(const Ray& ray, const embree::Query& query, const RTCRayHit& hit) const;
    Surface surface_of_mesh(const Ray& ray, const RTCRayHit& hit) const;
    /// Whether nothing is between two points. The ray has reached the first one.
    bool is_free(const Ray& ray, const glm::vec3& from, const glm::vec3& to) const;

    Hit intersect_several(const Ray& ray, float far, PathCounters& counters) const;
    NextOfSeveral next_of_several(const Ray& ray, float far, PathCounters& counters) const;
    CrossingInScene crossing_in_scene(const PlacedQuery& query, const RTCRayHit& hit) const;
    Met with_what_touches(const Ray& ray, const CrossingInScene& first, PathCounters& counters) const;
    Surface surface_of_several(const Ray& ray, const Met& met, double distance) const;
    static Ray behind(const Ray& ray, const Met& met);

    const Scene& scene_;
    std::vector<std::shared_ptr<const InterfaceCells>> cells_;  ///< of each object
    DeviceHandle device_;
    std::optional<embree::CellGeometry> tree_;  ///< for a scene with one tree
    std::optional<PlacedGeometry> placed_;      ///< for a scene with several objects
    SceneHandle embree_;
    std::vector<std::unique_ptr<const MovingMesh>> moving_meshes_;  ///< of each mesh; null if it stands still
    std::vector<Bounds> mesh_bounds_;                               ///< of each mesh, at all times
    std::uint32_t first_mesh_;                                      ///< number of the first mesh in Surface::object
    InterfaceTable interfaces_;
    std::vector<Interface> mesh_interfaces_;  ///< [mesh · phases + phase of the ray]
    float surface_epsilon_;                   ///< minimum offset of rays that leave a mesh
};

}  // namespace phasetree::tracer
