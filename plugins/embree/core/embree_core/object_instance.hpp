#pragma once

#include <array>

#include "embree_core/embree.hpp"

namespace phasetree::embree {

/// Which of the objects in a scene: a geometry, and the instances within which a ray meets it, the outermost first. So
/// two instances of one geometry are two objects, and a ray can be in different phases of them.
struct ObjectInstance {
    /// Embree's IDs of instances; RTC_INVALID_GEOMETRY_ID behind the last one.
    using Path = std::array<unsigned, RTC_MAX_INSTANCE_LEVEL_COUNT>;

    unsigned geometry = RTC_INVALID_GEOMETRY_ID;
    Path instances = outside();
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
    Path instance_primitives = outside();  ///< which instance of an array; Embree has 0 for those that are in none
#endif

    bool operator==(const ObjectInstance&) const = default;

    /// The path of an object that is in no instance.
    static constexpr Path outside() {
        Path path{};
        path.fill(RTC_INVALID_GEOMETRY_ID);
        return path;
    }
    /// The object that a callback is asked for, and the one that a ray has hit.
    static ObjectInstance of(const Context& context, unsigned geometry) {
        return at(context, geometry);
    }
    static ObjectInstance of(const RTCHit& hit) {
        return at(hit, hit.geomID);
    }

  private:
    template <class Place>
    static ObjectInstance at(const Place& place, unsigned geometry) {
        ObjectInstance object;
        object.geometry = geometry;
        for (std::size_t level = 0; level < object.instances.size(); ++level) {
            object.instances[level] = place.instID[level];
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
            object.instance_primitives[level] = place.instPrimID[level];
#endif
        }
        return object;
    }
};

}  // namespace phasetree::embree
