// The scene in Embree: the object as user geometry, or several in their places, the meshes beside it, and the optics of
// all their surfaces.
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
#include "world/placed_geometry.hpp"
#include "world/ray.hpp"
#include "world/world_options.hpp"

namespace phasetree::tracer {

/// How the cells of a scene's objects are built.
CellOptions cell_options(const Scene&, const WorldOptions&);

class TracedGeometry {
  public:
    /// Refers to the scene, which must outlive it. Throws ModelError for an object that cannot be traced, and
    /// BuildCancelled once WorldOptions::cancelled says so.
    explicit TracedGeometry(const Scene& scene, const WorldOptions& = {});

    /// What a ray meets first.
    Hit intersect(const Ray& ray, PathCounters& counters) const;
    /// What stands first in the way of light along a ray, before the distance `far`.
    Visibility visibility(const Ray& ray, float far, PathCounters& counters) const;

    /// The way that a ray goes through the medium of its phase. Where the medium's density varies, the way is in the
    /// space of the first object that the ray is in. Its direction is not of unit length there, so that lengths are
    /// the scene's.
    Way way_through_medium(const Ray& ray, float length, const Wavelengths* wavelengths = nullptr) const;

    /// The phase at a point, at a share of the time in which the shutter is open.
    Phase label(const glm::vec3& p, float time = 0) const { return inside(p, time).phase; }
    /// The phase at a point, and the objects that it is in if the scene has several: as a ray has them that starts
    /// there.
    struct Inside {
        Phase phase{};
        RayObjects in{};
    };
    Inside inside(const glm::vec3& p, float time = 0) const;

    /// The object of a scene of one tree.
    const InterfaceCells& object() const { return *cells_.front(); }
    /// Every object, in the order of PlacedObjects::objects.
    const std::vector<std::shared_ptr<const InterfaceCells>>& objects() const { return cells_; }
    /// Of all objects together: of numbers for each cell the greatest.
    CellStatistics statistics() const;
    /// A box around all objects.
    const Bounds& bounds() const { return placed_ ? placed_->bounds() : object().bounds(); }

  private:
    TracedGeometry(const Scene& scene, const WorldOptions& options, const std::shared_ptr<SharedSurfaces>& shared);

    /// A change of phase in one of several objects, as it lies in the scene.
    struct CrossingInScene {
        Crossing crossing;  ///< in the object's space
        Copy copy;
        StartHint hint;
        double distance = 0;            ///< along the ray
        glm::vec3 p_in{0}, p_out{0};    ///< the ends of the bracket
        glm::vec3 normal{0};            ///< of unit length, on the side the ray comes from
        glm::vec3 normal_in_object{0};  ///< the same in the object's space
        double tolerance = 0;           ///< PlacedGeometry::tolerance
    };
    /// Two such within their tolerances, or one.
    struct Met {
        CrossingInScene first;
        std::optional<CrossingInScene> joined;  ///< another object begins where the one ends
        RayObjects behind;

        double apart() const { return joined ? first.tolerance + joined->tolerance : 0.0; }
    };
    using NextOfSeveral = std::variant<Escaped, RTCRayHit, CrossingInScene>;

    bool trace(const Ray& ray, float far, embree::Query& query, RTCRayHit& hit, PathCounters& counters) const;
    /// The mesh that stands flush with an interface, if there is one and light goes on behind the interface, in the
    /// phase `to`. The interface is known to lie between the points p_in, which is `distance` from the ray's origin,
    /// and p_out. The ray would go on from p_out and could start behind the mesh, so a mesh between the two counts as
    /// if it stood before the interface.
    std::optional<RTCRayHit> mesh_flush_with_interface(const Ray& ray, Phase to, float distance, const glm::vec3& p_in,
                                                       const glm::vec3& p_out) const;
    Surface surface_of_object(const Ray& ray, const embree::Query& query, const RTCRayHit& hit) const;
    Surface surface_of_mesh(const Ray& ray, const RTCRayHit& hit) const;
    /// Whether nothing is between two points, of which the first is where the ray has come to.
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
    std::optional<embree::CellGeometry> tree_;  ///< of a scene of one tree
    std::optional<PlacedGeometry> placed_;      ///< of a scene of several objects
    SceneHandle embree_;
    std::vector<Bounds> mesh_bounds_;
    std::uint32_t first_mesh_;  ///< the number of the first mesh, as Surface::object has it
    InterfaceTable interfaces_;
    std::vector<Interface> mesh_interfaces_;  ///< [mesh · phases + phase the ray is in]
    float surface_epsilon_;                   ///< least distance by which rays that leave a mesh are moved off it
};

}  // namespace phasetree::tracer
