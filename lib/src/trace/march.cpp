#include "trace/march.hpp"

#include "evaluation/target.hpp"
#include "trace/creep.hpp"

namespace phasetree::trace {

using evaluation::active_kernel;
using kernel::RayCrossing;

std::optional<Crossing> first_crossing(const Visit& visit, TraceCounters& counters) {
    RayCrossing c;
    bool is_hit = active_kernel().visit(visit, c);
    counters.batches += c.batches;
    counters.phantoms += c.phantoms;
    if (c.is_unfinished) [[unlikely]]
        is_hit = finish_search(visit, c, counters);
    if (!is_hit) return std::nullopt;
    const glm::vec3 start{c.origin[0], c.origin[1], c.origin[2]}, &direction = visit.ray->direction;
    return Crossing{static_cast<float>(c.start + static_cast<double>(c.t_from)),
                    static_cast<float>(c.start + static_cast<double>(c.t_to)),
                    start + c.t_from * direction,
                    start + c.t_to * direction,
                    Phase{static_cast<std::uint8_t>(c.from)},
                    Phase{static_cast<std::uint8_t>(c.to)}};
}

}  // namespace phasetree::trace
