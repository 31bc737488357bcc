#pragma once

#include "cells/linear_bound.hpp"
#include "kernel/kernel.hpp"
#include "phasetree/trace/crossing.hpp"
#include "phasetree/trace/ray.hpp"

namespace phasetree {

struct Interval {
    double low, high;
};

/// Where a ray is within a box, clipped to [t_min, t_max]; empty if low > high. In double, so that an origin far from
/// the object costs no accuracy.
Interval clip(const Bounds& box, const TracedRay&, double t_min, double t_max);

/// The first change of label of a routine within a box, searched for from the ray's entry on, so that t is small and
/// exact there; and only where the field's linear bound leaves an interface possible. A ray that starts inside keeps
/// its very origin. `slots` batches are what the routine needs. The search itself is the kernel's:
/// src/kernel/march.inl. Departure is about a crossing that this routine found.
std::optional<Crossing> march_within(const Bounds& box, const LinearBound&, const Curvature&, const Routine&,
                                     std::uint32_t slots, const TracedRay&, float t_min, float t_max, float resolution,
                                     std::optional<Phase> carried, const std::optional<Departure>&,
                                     Evaluator::Workspace*, TraceCounters&);

}  // namespace phasetree
