#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "embree_core/rays.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree::embree {

/// A ray prepared for searching cells. Embree passes the same ray from cell to cell, so this is done once.
struct PreparedRay {
    glm::vec3 origin{0}, direction{0};  ///< as given
    float length = 0;                   ///< of the direction; 0 if the ray cannot hit anything
    TracedRay traced;

    PreparedRay() = default;
    explicit PreparedRay(const RTCRay& given)
        : origin(given.org_x, given.org_y, given.org_z),
          direction(given.dir_x, given.dir_y, given.dir_z),
          length(usable_length(origin, direction)),
          traced(length > 0 ? TracedRay(origin, unit_direction(direction, length)) : TracedRay()) {}
    /// Whether it is this ray, to the last bit.
    bool is(const RTCRay& given) const {
        return std::memcmp(&origin, &given.org_x, sizeof origin) == 0 &&
               std::memcmp(&direction, &given.dir_x, sizeof direction) == 0;
    }
};

/// Find the first crossing of a ray within a cell, between the ray's tnear and tfar. All tracing through Embree goes
/// through this function.
///
/// All of the ray in the cell is searched, even beyond tfar. The bits of the crossing then do not depend on tfar.
/// Embree sets tfar to the nearest hit so far, so it depends on the order in which Embree visits cells, which differs
/// from processor to processor.
inline std::optional<Crossing> search_cell(const InterfaceCells& cells, unsigned cell, const PreparedRay& prepared,
                                           const RTCRay& ray, std::optional<Phase> carried,
                                           const std::optional<LeavingHint>& leaving_hint, TraceCounters& counters) {
    const float near = std::max(ray.tnear * prepared.length, 0.0f), far = ray.tfar * prepared.length;
    std::optional<Crossing> crossing;
    if (!(near <= far)) return crossing;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    crossing = cells.first_crossing(cell, prepared.traced, near, infinity, carried, leaving_hint, counters);
    if (!crossing) return crossing;
    // For a ray that starts at an interface, rounding may put the crossing slightly before the start.
    crossing->t_from = std::max(crossing->t_from, near);
    if (!(crossing->t_from / prepared.length <= ray.tfar)) crossing.reset();
    return crossing;
}

}  // namespace phasetree::embree
