// A scene of many objects: what there is, and where it stands. Objects have places; groups are lists of places of
// objects and of other groups, which stand in turn. What a place leads to in the end, through all groups, is a *copy*
// of an object; copies are numbered in the order of the places, so that every one has a number of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "scene/transform.hpp"

namespace phasetree::tracer {

struct PlacedObject {
    std::string name;
    Phased tree;      ///< in its own space; its phases are numbered as the scene's
    Transform first;  ///< its own transform, which comes before that of each place
};

/// Where an object or a group stands.
struct Place {
    Transform transform{};  ///< from what stands there to what the place is in
    std::uint32_t of = 0;   ///< number of an object, or of a group
    bool is_group = false;
};

struct PlacedGroup {
    std::string name;
    std::vector<Place> places;  ///< groups among them have smaller numbers
    std::uint64_t copies = 0;   ///< of objects, through all groups
    std::size_t depth = 1;      ///< how many groups are nested here, with this one
};

struct PlacedObjects {
    std::vector<PlacedObject> objects;
    std::vector<PlacedGroup> groups;
    std::vector<Place> places;  ///< of the scene

    bool empty() const { return objects.empty(); }
    std::uint64_t copies_at(const Place& place) const { return place.is_group ? groups[place.of].copies : 1; }
    std::uint64_t copies_of(const std::vector<Place>& list) const {
        std::uint64_t sum = 0;
        for (const Place& place : list) sum += copies_at(place);
        return sum;
    }
    std::uint64_t copies() const { return copies_of(places); }

    /// Calls use(number, object, transform from the object's tree to the scene) for each copy, in the order of their
    /// numbers, until it says false. There may be billions.
    template <class Use>
    void each_copy(Use&& use) const {
        std::uint32_t next = 0;
        each_copy(places, Transform(), next, use);
    }

  private:
    template <class Use>
    bool each_copy(const std::vector<Place>& list, const Transform& outer, std::uint32_t& next, Use& use) const {
        for (const Place& place : list) {
            const Transform here = outer * place.transform;
            const bool goes_on = place.is_group ? each_copy(groups[place.of].places, here, next, use)
                                                : use(next++, objects[place.of], here * objects[place.of].first);
            if (!goes_on) return false;
        }
        return true;
    }
};

/// Numbers of copies are below this, and so many lists of places there may be in all.
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
/// Throws SceneError. `places` is told of the nodes of the objects whose phases keep the numbers that their file gives.
ObjectsModel read_placed_objects(const Document&, NodePlaces* places = nullptr);

}  // namespace phasetree::tracer
