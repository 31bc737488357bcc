// The objects of a scene and their placements in Embree. An Embree scene contains the cells of one object, or the
// instances of one group. An instance is a primitive of a user geometry, which transforms the ray into the space of its
// target and traces it in the target's scene. So groups can be nested to any depth, which Embree's own instances allow
// only if Embree was built for that.
#pragma once

#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "embree_core/cell_geometry.hpp"
#include "scene/placed.hpp"
#include "world/ray_objects.hpp"

namespace phasetree::tracer {

struct ReleaseEmbree {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseEmbree>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseEmbree>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseEmbree>;

/// The copy that a ray has met, or that contains a point.
struct Copy {
    std::uint32_t number = 0;  ///< scene/placed.hpp
    std::uint32_t object = 0;
    Transform to_object{};  ///< from scene space to the object's tree
};

/// Inputs and results of a ray in instances. Embree's context comes first, as in embree::Query.
struct PlacedQuery {
    embree::Query query;
    /// In: the copy at whose interface the ray starts, if any.
    std::optional<StartInCopy> start{};
    /// In: the length of the ray.
    float far = 0;
    /// Out: the copy of the hit, if it is in a copy.
    Copy hit{};

    // State while descending through nested instances: the transform from scene space to the current space; the ray in
    // scene space, with unit direction (inner directions are not normalised, so that distances remain those of the
    // scene); and the number of the first copy below, which is the sum of EmbreeInstance::first_copy over the instances
    // on the way.
    Transform here{};
    glm::dvec3 origin{0}, direction{0};
    std::uint32_t first_copy = 0;
    /// In: a share of the shutter interval.
    double time = 0;
};

class PlacedGeometry {
  public:
    /// Refers to the objects, which must outlive it. `cells` are those of each object. Throws ModelError if a placed
    /// object is outside of the range of coordinates.
    PlacedGeometry(RTCDevice device, const PlacedObjects& placed,
                   std::vector<std::shared_ptr<const InterfaceCells>> cells);
    // Lists of instances refer to it, and Embree to them.
    PlacedGeometry(const PlacedGeometry&) = delete;
    PlacedGeometry& operator=(const PlacedGeometry&) = delete;

    /// The user geometry of the scene's instances, which is committed. A query that can reach it must be the first
    /// member of a PlacedQuery.
    RTCGeometry handle() const { return root_->geometry.get(); }
    const Bounds& bounds() const { return root_->bounds; }
    const std::vector<std::shared_ptr<const InterfaceCells>>& cells() const { return cells_; }

    /// The objects that contain a point of the scene at a share of the shutter interval. `scene` must have the geometry
    /// as its first one.
    RayObjects objects_at(RTCScene scene, const glm::vec3& p, float time) const;

    /// The transform from scene space to the space of a copy's object, at a share of the shutter interval. Takes a
    /// binary search per level of groups that contain the copy.
    Transform to_object(std::uint32_t copy, float time) const;

    /// The maximum distance, in the scene's unit of length, between two interfaces that cannot be distinguished near a
    /// point given the cells of this copy: two resolutions plus the rounding of coordinates.
    double tolerance(std::uint32_t object, const Transform& to_scene, const glm::vec3& p) const;
    /// The maximum of tolerance() anywhere.
    double most_tolerance() const { return most_tolerance_; }

    struct InstanceList;
    /// The target of an instance: an object's cells, or the instances of a group.
    struct Target {
        RTCScene scene = nullptr;
        Bounds bounds{};
        const InterfaceCells* cells = nullptr;  ///< null for a group
        std::uint32_t object = 0;
        const InstanceList* instances = nullptr;  ///< null for an object
        double resolution = 0;                    ///< coarsest in it, in its space
        double look_back = 0;                     ///< largest InterfaceCells::look_back in it, in its space
    };
    struct EmbreeInstance {
        Transform inward;  ///< from the space of the list into that of the target, if it does not move
        Bounds bounds;     ///< of all crossings that may be found in it (look_back), during the shutter interval
        std::uint32_t target = 0;
        bool moves = false;
        std::uint32_t first_copy = 0;  ///< number of the target's first copy among those of the list
    };
    /// A list of instances, as used by callbacks.
    struct InstanceList {
        std::vector<EmbreeInstance> list;
        const std::vector<Target>* targets = nullptr;
        /// The scene's own instances; `source` is the list from which this one was made. A moving instance gets its
        /// transform at a ray's time from there.
        const PlacedObjects* placed = nullptr;
        const std::vector<Instance>* source = nullptr;
        Bounds bounds{};
        double resolution = 0;  ///< coarsest in it, in the space of the list
        double look_back = 0;   ///< largest in it, in the space of the list
        GeometryHandle geometry;
        SceneHandle scene;  ///< contains only the geometry; null for the scene's own list
    };

  private:
    std::unique_ptr<InstanceList> made(RTCDevice device, const PlacedObjects& placed,
                                       const std::vector<Instance>& list);

    std::vector<std::shared_ptr<const InterfaceCells>> cells_;
    std::vector<embree::CellGeometry> geometries_;
    std::vector<SceneHandle> scenes_;                    ///< of the cells of each object
    std::vector<Target> targets_;                        ///< the objects, then the groups
    std::vector<std::unique_ptr<InstanceList>> groups_;  ///< pointers because callbacks keep their addresses
    std::unique_ptr<InstanceList> root_;
    double most_tolerance_ = 0;
};

}  // namespace phasetree::tracer
