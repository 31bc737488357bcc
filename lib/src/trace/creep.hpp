// Rays that creep along an interface.
//
// Where a ray runs within a face, an edge or a seam its distance from the interface is zero up to rounding
// errors over a long way, and a sample proves nothing beyond a resolution around it. After some batches the kernel
// leaves such a search unfinished. It is finished here, in two ways.
//
// *Enclosed stretches.* The component φ of the ray's phase is bounded over a whole stretch of the ray by interval
// arithmetic with derivatives (ComponentAlongRay). Where φ < resolution/16 all along it, no other phase is deeper than
// the rounding error, and the ray goes on behind the stretch. (This is where creeping rays differ from others: for
// these a phase that is never deeper than the rounding error counts as well if it lasts for one and a half resolutions,
// March::is_crossing.) A creep along a plane is one such stretch; along a curved surface stretches are about
// √(resolution · radius) long.
//
// *Walks.* Where nothing can be proven (outlines, patterns and images, whose derivatives are not known) the ray walks
// in steps of a resolution, eight in a batch, while the interface is near. Where the label flickers by rounding errors
// the kernel goes on, at three resolutions a batch.
//
// So the work is bounded by the length of the creep. At the resolution that is chosen for an object the longest ray
// through it has half a million resolutions. At finer resolutions there may be more. After this many batches
// (most_batches, of all kinds) each further walk, of at most 256 batches, takes steps twice as long as those of the
// walk before, so that no ray takes forever. Once the ray is away from the interface, steps are a resolution again.
// What lies behind a walk the kernel searches at the resolution.
#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

/// Finishes a search that the kernel has left unfinished; returns whether there is a crossing. The counters are added
/// to.
bool finish_search(const kernel::Visit&, kernel::RayCrossing&, TraceCounters&);

}  // namespace phasetree::trace
