// The objects of a scene and their places in Embree. A scene of Embree holds the cells of one object, or the places of
// one group; a place is a primitive of a user geometry, which takes the ray into the space of what stands there and
// has it traced in that one's scene. So any number of groups may be nested, which Embree's own instances allow only
// where it was built for that.
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

/// Which copy a ray has met, or a point lies in.
struct Copy {
    std::uint32_t number = 0;  ///< scene/placed.hpp
    std::uint32_t object = 0;
    Transform to_object{};  ///< from the scene to the object's tree
};

/// What a ray brings along through places, and what it finds. Embree's context comes first, as in embree::Query.
struct PlacedQuery {
    embree::Query query;
    /// In: the copy at whose interface the ray starts, if it does.
    std::optional<StartInCopy> start{};
    /// In: how far the ray goes.
    float far = 0;
    /// Out: the copy that the hit is in, if the hit is one of a copy.
    Copy hit{};

    // On the way down through nested places: the map from the scene to the space that the ray is in now; the ray in the
    // scene's space, of unit direction (inner directions are not normalised, so that distances stay the scene's); and
    // the number of the first copy below, which is the sum of PlaceInEmbree::first_copy over the places on the way.
    Transform here{};
    glm::dvec3 origin{0}, direction{0};
    std::uint32_t first_copy = 0;
    /// In: a share of the time in which the shutter is open.
    double time = 0;
};

class PlacedGeometry {
  public:
    /// Refers to the objects, which must outlive it. `cells` are those of each object. Throws ModelError if what is
    /// placed leaves the range of coordinates.
    PlacedGeometry(RTCDevice device, const PlacedObjects& placed,
                   std::vector<std::shared_ptr<const InterfaceCells>> cells);
    // Lists of places refer to it, and Embree to them.
    PlacedGeometry(const PlacedGeometry&) = delete;
    PlacedGeometry& operator=(const PlacedGeometry&) = delete;

    /// The user geometry of the scene's places, which is committed. A query that meets it must be the first member of a
    /// PlacedQuery.
    RTCGeometry handle() const { return root_->geometry.get(); }
    const Bounds& bounds() const { return root_->bounds; }
    const std::vector<std::shared_ptr<const InterfaceCells>>& cells() const { return cells_; }

    /// The objects that hold a point of the scene at a share of the time in which the shutter is open. `scene` is one
    /// to which the geometry is attached as the first.
    RayObjects objects_at(RTCScene scene, const glm::vec3& p, float time) const;

    /// From the scene to the space of a copy's object, at a share of the time in which the shutter is open. It takes
    /// a binary search for each level of groups that the copy is in.
    Transform to_object(std::uint32_t copy, float time) const;

    /// How far apart two interfaces may be, in the scene's unit of length, to be one and the same as far as the cells
    /// of this copy can tell near a point: two resolutions, and what coordinates round away.
    double tolerance(std::uint32_t object, const Transform& to_scene, const glm::vec3& p) const;
    /// The most that tolerance() is anywhere.
    double most_tolerance() const { return most_tolerance_; }

    struct Places;
    /// What stands at a place: an object's cells, or the places of a group.
    struct Target {
        RTCScene scene = nullptr;
        Bounds bounds{};
        const InterfaceCells* cells = nullptr;  ///< none of a group
        std::uint32_t object = 0;
        const Places* places = nullptr;  ///< none of an object
        double resolution = 0;           ///< the coarsest there, in its space
    };
    struct PlaceInEmbree {
        Transform inward;  ///< from the space of the list into that of what stands there, if it stands still
        Bounds bounds;     ///< while the shutter is open
        std::uint32_t target = 0;
        bool moves = false;
        std::uint32_t first_copy = 0;  ///< of what stands here, among those of the list
    };
    /// A list of places: what the callbacks read.
    struct Places {
        std::vector<PlaceInEmbree> list;
        const std::vector<Target>* targets = nullptr;
        /// The scene's own places, of which `source` is the list that this one was made from: a place that moves has
        /// its transform at a ray's time from there.
        const PlacedObjects* placed = nullptr;
        const std::vector<Place>* source = nullptr;
        Bounds bounds{};
        double resolution = 0;  ///< the coarsest there, in the space of the list
        GeometryHandle geometry;
        SceneHandle scene;  ///< which holds the geometry alone; none of the scene's own list
    };

  private:
    std::unique_ptr<Places> made(RTCDevice device, const PlacedObjects& placed, const std::vector<Place>& list);

    std::vector<std::shared_ptr<const InterfaceCells>> cells_;
    std::vector<embree::CellGeometry> geometries_;
    std::vector<SceneHandle> scenes_;              ///< of the cells of each object
    std::vector<Target> targets_;                  ///< the objects, then the groups
    std::vector<std::unique_ptr<Places>> groups_;  ///< callbacks have their addresses
    std::unique_ptr<Places> root_;
    double most_tolerance_ = 0;
};

}  // namespace phasetree::tracer
