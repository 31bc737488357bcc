#pragma once

#include <array>
#include <compare>

#include "embree_core/embree.hpp"

namespace phasetree::embree {

/// Identifies an object in a scene: a geometry, and the instances through which a ray reaches it, outermost first. Two
/// instances of one geometry are therefore two objects, and a ray can be in different phases of them.
struct ObjectInstance {
    /// Embree's instance IDs, followed by RTC_INVALID_GEOMETRY_ID.
    using Path = std::array<unsigned, RTC_MAX_INSTANCE_LEVEL_COUNT>;

    unsigned geometry = RTC_INVALID_GEOMETRY_ID;
    Path instances = outside();
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
    Path instance_primitives = outside();  ///< index in an instance array; Embree sets 0 for other instances
#endif

    auto operator<=>(const ObjectInstance&) const = default;

    /// The path of an object outside all instances.
    static constexpr Path outside() {
        Path path{};
        path.fill(RTC_INVALID_GEOMETRY_ID);
        return path;
    }
    /// The object for which a callback is called, and the object that a ray has hit.
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
