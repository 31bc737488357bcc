// A scene of many objects and where they are placed. An instance refers to an object or to a group, which is a list of
// instances itself. A *copy* is an object as reached from the scene through one chain of instances. Copies are numbered
// in the order of the instances, so each has a unique number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "scene/moving_transform.hpp"
#include "scene/shutter.hpp"
#include "scene/transform.hpp"

namespace phasetree::tracer {

/// Used instead of an index into PlacedObjects::moving.
inline constexpr std::uint32_t stands_still = 0xFFFFFFFF;

struct PlacedObject {
    std::string name;
    Phased tree;      ///< in its own space; uses the scene's phase numbers
    Transform first;  ///< its own transform, applied before those of instances; at shutter opening if it moves
    std::uint32_t moving = stands_still;  ///< index of this transform in PlacedObjects::moving
};

/// The placement of an object or a group.
struct Instance {
    Transform transform{};  ///< from the object or group to the list's space; applied before any motion
    std::uint32_t of = 0;   ///< number of an object, or of a group
    bool is_group = false;
    std::uint32_t moving = stands_still;  ///< index in PlacedObjects::moving of the motion applied after `transform`
};

struct PlacedGroup {
    std::string name;
    std::size_t offset = 0;           ///< byte offset of its name in the file
    std::vector<Instance> instances;  ///< groups among them have smaller numbers
    std::uint64_t copies = 0;         ///< number of object copies, through all groups
    std::size_t depth = 1;            ///< number of nested groups, including this one
};

struct PlacedObjects {
    std::vector<PlacedObject> objects;
    std::vector<PlacedGroup> groups;
    std::vector<Instance> instances;  ///< instances of the scene itself
    std::vector<MovingTransform> moving;

    /// The own transform of an object, and the transform of an instance, at a moment given as a fraction of the time in
    /// which the shutter is open.
    Transform first_of(const PlacedObject& object, double time) const {
        return object.moving == stands_still ? object.first : moving[object.moving].at(time);
    }
    Transform transform_of(const Instance& instance, double time) const {
        return instance.moving == stands_still ? instance.transform
                                               : moving[instance.moving].at(time) * instance.transform;
    }
    /// For each object, whether any copy of it moves.
    std::vector<bool> moving_objects() const;

    bool empty() const { return objects.empty(); }
    std::uint64_t copies_at(const Instance& instance) const {
        return instance.is_group ? groups[instance.of].copies : 1;
    }
    std::uint64_t copies_of(const std::vector<Instance>& list) const {
        std::uint64_t sum = 0;
        for (const Instance& instance : list) sum += copies_at(instance);
        return sum;
    }
    std::uint64_t copies() const { return copies_of(instances); }

    /// Calls use(number, object, transform from the object's tree to the scene) for each copy, in the order of their
    /// numbers, until it returns false. There may be billions. `time` is a fraction of the time in which the shutter is
    /// open.
    template <class Use>
    void each_copy(Use&& use, double time = 0) const {
        std::uint32_t next = 0;
        each_copy(instances, Transform(), time, next, use);
    }

  private:
    template <class Use>
    bool each_copy(const std::vector<Instance>& list, const Transform& outer, double time, std::uint32_t& next,
                   Use& use) const {
        for (const Instance& instance : list) {
            const Transform here = outer * transform_of(instance, time);
            const bool goes_on = instance.is_group
                                     ? each_copy(groups[instance.of].instances, here, time, next, use)
                                     : use(next++, objects[instance.of], here * first_of(objects[instance.of], time));
            if (!goes_on) return false;
        }
        return true;
    }
};

/// Exclusive upper bound on copy numbers, and the maximum number of instances in all lists.
inline constexpr std::uint64_t max_copies = 1'000'000'000, most_instances = 20'000'000;

/// The objects of a scene file without their materials, which are read from the listed sources.
struct ObjectsModel {
    struct Source {
        Document document;
        Value material;
    };
    PhaseNames phases;
    std::vector<Source> materials;  ///< of the phases from 1 on
    PlacedObjects placed;
};

/// Whether the document is a scene of several objects, that is, has "objects".
bool has_objects(const Document&);
/// Reads "objects", "groups" and "instances", with the phases and shapes that they need, and "tree" as an additional
/// object. Throws SceneError. `node_places` receives the positions of the objects' nodes in the text.
ObjectsModel read_placed_objects(const Document&, const Shutter& = {}, NodePlaces* node_places = nullptr);

}  // namespace phasetree::tracer
