#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

using kernel::Visit;

/// Finds the first change of label (the phase at a point) along the part of a ray inside a box. The kernel searches
/// (kernel/visit.inl); if it leaves the search unfinished, this function finishes it. The search starts where the ray
/// enters the box, so that t is small and exact there. A ray that starts inside keeps its own origin. Adds to the
/// counters.
std::optional<Crossing> first_crossing(const Visit&, TraceCounters&);

/// A phase in the representation of Visit::carried.
inline float carried_by(const std::optional<Phase>& phase) {
    return phase ? static_cast<float>(phase->index) : -1.f;
}

}  // namespace phasetree::trace
