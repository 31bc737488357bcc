// A scene of many objects and where they are placed. A place refers to an object or to a group, which is a list of
// places itself. A *copy* is an object as reached from the scene through one chain of places. Copies are numbered in
// the order of the places, so each has a unique number.
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
    Transform first;  ///< its own transform, applied before those of places; at shutter opening if it moves
    std::uint32_t moving = stands_still;  ///< index of this transform in PlacedObjects::moving
};

/// The placement of an object or a group.
struct Place {
    Transform transform{};  ///< from the object or group to the list's space; applied before any motion
    std::uint32_t of = 0;   ///< number of an object, or of a group
    bool is_group = false;
    std::uint32_t moving = stands_still;  ///< index in PlacedObjects::moving of the motion applied after `transform`
};

struct PlacedGroup {
    std::string name;
    std::size_t offset = 0;     ///< byte offset of its name in the file
    std::vector<Place> places;  ///< groups among them have smaller numbers
    std::uint64_t copies = 0;   ///< number of object copies, through all groups
    std::size_t depth = 1;      ///< number of nested groups, including this one
};

struct PlacedObjects {
    std::vector<PlacedObject> objects;
    std::vector<PlacedGroup> groups;
    std::vector<Place> places;  ///< places of the scene itself
    std::vector<MovingTransform> moving;

    /// The own transform of an object, and the transform of a place, at a moment given as a fraction of the time in
    /// which the shutter is open.
    Transform first_of(const PlacedObject& object, double time) const {
        return object.moving == stands_still ? object.first : moving[object.moving].at(time);
    }
    Transform transform_of(const Place& place, double time) const {
        return place.moving == stands_still ? place.transform : moving[place.moving].at(time) * place.transform;
    }
    /// For each object, whether any copy of it moves.
    std::vector<bool> moving_objects() const;

    bool empty() const { return objects.empty(); }
    std::uint64_t copies_at(const Place& place) const { return place.is_group ? groups[place.of].copies : 1; }
    std::uint64_t copies_of(const std::vector<Place>& list) const {
        std::uint64_t sum = 0;
        for (const Place& place : list) sum += copies_at(place);
        return sum;
    }
    std::uint64_t copies() const { return copies_of(places); }

    /// Calls use(number, object, transform from the object's tree to the scene) for each copy, in the order of their
    /// numbers, until it returns false. There may be billions. `time` is a fraction of the time in which the shutter is
    /// open.
    template <class Use>
    void each_copy(Use&& use, double time = 0) const {
        std::uint32_t next = 0;
        each_copy(places, Transform(), time, next, use);
    }

  private:
    template <class Use>
    bool each_copy(const std::vector<Place>& list, const Transform& outer, double time, std::uint32_t& next,
                   Use& use) const {
        for (const Place& place : list) {
            const Transform here = outer * transform_of(place, time);
            const bool goes_on = place.is_group
                                     ? each_copy(groups[place.of].places, here, time, next, use)
                                     : use(next++, objects[place.of], here * first_of(objects[place.of], time));
            if (!goes_on) return false;
        }
        return true;
    }
};

/// Exclusive upper bound of copy numbers, and the maximum number of places in all lists.
inline constexpr std::uint64_t most_copies = 1'000'000'000, most_places = 20'000'000;

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
/// object. Throws SceneError. `places` receives the positions of the objects' nodes in the text.
ObjectsModel read_placed_objects(const Document&, const Shutter& = {}, NodePlaces* places = nullptr);

}  // namespace phasetree::tracer
