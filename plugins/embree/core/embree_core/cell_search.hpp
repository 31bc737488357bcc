#pragma once

#include <algorithm>
#include <cstring>
#include <optional>

#include "embree_core/rays.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree::embree {

/// A ray as cells see it. Embree passes the same ray from cell to cell, so it is prepared only once.
struct SeenRay {
    glm::vec3 origin{0}, direction{0};  ///< as given
    float length = 0;                   ///< of the direction; 0 if the ray cannot hit anything
    TracedRay traced;

    SeenRay() = default;
    explicit SeenRay(const RTCRay& given)
        : origin(given.org_x, given.org_y, given.org_z),
          direction(given.dir_x, given.dir_y, given.dir_z),
          length(usable_length(origin, direction)),
          traced(length > 0 ? TracedRay(origin, unit_direction(direction, length)) : TracedRay()) {}
    /// Whether this is the given ray, bit for bit.
    bool is(const RTCRay& given) const {
        return std::memcmp(&origin, &given.org_x, sizeof origin) == 0 &&
               std::memcmp(&direction, &given.dir_x, sizeof direction) == 0;
    }
};

/// The first crossing of a ray within a cell, from the ray's tnear to its tfar. All tracing of objects through Embree
/// uses this function.
inline std::optional<Crossing> search_cell(const InterfaceCells& cells, unsigned cell, const SeenRay& seen,
                                           const RTCRay& ray, std::optional<Phase> carried,
                                           const std::optional<LeavingHint>& leaving_hint, TraceCounters& counters) {
    const float near = std::max(ray.tnear * seen.length, 0.0f), far = ray.tfar * seen.length;
    std::optional<Crossing> crossing;
    if (!(near <= far)) return crossing;
    crossing = cells.first_crossing(cell, seen.traced, near, far, carried, leaving_hint, counters);
    if (!crossing) return crossing;
    // For a ray that starts at an interface, rounding may put the crossing slightly before the start.
    crossing->t_in = std::max(crossing->t_in, near);
    if (!(crossing->t_in <= far)) crossing.reset();  // only rounding put it within the ray
    return crossing;
}

}  // namespace phasetree::embree
