#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

using kernel::Visit;

/// The first change of label of a routine within a box, searched for from the ray's entry on, so that t is small and
/// exact there; and only where the field's linear bound leaves an interface possible. A ray that starts inside keeps
/// its very origin. The search itself is the kernel's: src/kernel/visit.inl.
std::optional<Crossing> first_crossing(const Visit&, TraceCounters&);

inline float carried_by(const std::optional<Phase>& phase) {
    return phase ? static_cast<float>(phase->index) : -1.f;
}

}  // namespace phasetree::trace
