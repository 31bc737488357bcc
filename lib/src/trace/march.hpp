#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

using kernel::Visit;

/// The first change of label along a ray within a box, which the kernel finds (kernel/visit.inl); a search that the
/// kernel leaves unfinished is finished. It starts where the ray enters the box, so that t is small and exact there. A
/// ray that starts inside keeps its own origin. The counters are added to.
std::optional<Crossing> first_crossing(const Visit&, TraceCounters&);

/// A phase in the form of Visit::carried.
inline float carried_by(const std::optional<Phase>& phase) {
    return phase ? static_cast<float>(phase->index) : -1.f;
}

}  // namespace phasetree::trace
