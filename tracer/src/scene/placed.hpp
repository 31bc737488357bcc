// A scene of many objects: what there is, and where it stands. Objects have places; groups are lists of places of
// objects and of other groups, which stand in turn. What a place leads to in the end, through all groups, is a *copy*
// of an object; copies are numbered in the order of the places, so that every one has a number of its own.
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

/// Instead of a number of PlacedObjects::moving.
inline constexpr std::uint32_t stands_still = 0xFFFFFFFF;

struct PlacedObject {
    std::string name;
    Phased tree;      ///< in its own space; its phases are numbered as the scene's
    Transform first;  ///< its own transform, which comes before that of each place; as the shutter opens, if it moves
    std::uint32_t moving = stands_still;  ///< which of PlacedObjects::moving that is
};

/// Where an object or a group stands.
struct Place {
    Transform transform{};  ///< from what stands there to what the place is in, unless it moves: then before that
    std::uint32_t of = 0;   ///< number of an object, or of a group
    bool is_group = false;
    std::uint32_t moving = stands_still;  ///< which of PlacedObjects::moving it goes through after `transform`
};

struct PlacedGroup {
    std::string name;
    std::size_t offset = 0;     ///< of its name in the file, in bytes
    std::vector<Place> places;  ///< groups among them have smaller numbers
    std::uint64_t copies = 0;   ///< of objects, through all groups
    std::size_t depth = 1;      ///< how many groups are nested here, with this one
};

struct PlacedObjects {
    std::vector<PlacedObject> objects;
    std::vector<PlacedGroup> groups;
    std::vector<Place> places;  ///< of the scene
    std::vector<MovingTransform> moving;

    /// Where an object stands by itself, and a place in its list, at a share of the time in which the shutter is open.
    Transform first_of(const PlacedObject& object, double time) const {
        return object.moving == stands_still ? object.first : moving[object.moving].at(time);
    }
    Transform transform_of(const Place& place, double time) const {
        return place.moving == stands_still ? place.transform : moving[place.moving].at(time) * place.transform;
    }
    /// Of each object, whether any copy of it moves.
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
    /// numbers, until it says false. There may be billions. `time` is a share of that in which the shutter is open.
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

/// Numbers of copies are below this, and this many lists of places there may be in all.
inline constexpr std::uint64_t most_copies = 1'000'000'000, most_places = 20'000'000;

/// What a scene file says of its objects, without their materials, which are read from the places that are named.
struct ObjectsModel {
    struct Source {
        Document document;
        Value material;
    };
    PhaseNames phases;
    std::vector<Source> materials;  ///< of the phases from 1 on
    PlacedObjects placed;
};

/// Whether the document is a scene of several objects: whether it has "objects".
bool has_objects(const Document&);
/// Reads "objects", "groups" and "instances", and "tree" as one object more, with the phases and shapes that they need.
/// Throws SceneError. `places` is told of the objects' nodes.
ObjectsModel read_placed_objects(const Document&, const Shutter& = {}, NodePlaces* places = nullptr);

}  // namespace phasetree::tracer
