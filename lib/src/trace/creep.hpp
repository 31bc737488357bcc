// Rays that creep along an interface.
//
// Where a ray runs within a face, an edge or a seam, its distance from the interface is zero up to rounding errors over
// a long stretch, and a sample proves nothing beyond a resolution around it. After some batches, the search kernel
// (kernel/visit.inl, which samples eight points at a time) leaves such a search unfinished. It is finished here, in two
// ways.
//
// *Enclosed stretches.* Interval arithmetic with derivatives bounds the component φ of the ray's phase (its signed
// distance, negative inside it) over a whole stretch of the ray (ComponentAlongRay). The sum of the components of two
// phases is never negative. Let ε = resolution/16 be the rounding error. If φ < ε all along the stretch, no other phase
// is deeper than ε there, and the ray passes the stretch. Here, creeping rays differ from others: for other rays, a
// phase that is never deeper than the rounding error still counts if it lasts for one and a half resolutions
// (March::decide_crossing). A creep along a plane is one such stretch; along a curved surface, stretches are about
// √(resolution · radius) long.
//
// *Walks.* Where nothing can be proven (outlines, patterns and images, whose derivatives are unknown), the ray walks in
// steps of a resolution, eight per batch, while the interface is near. Where the label (the phase found at a sample)
// flickers because of rounding errors, the kernel takes over, at three resolutions per batch.
//
// So the work is bounded by the length of the creep. At the resolution chosen for an object, the longest ray through it
// is half a million resolutions long; with a finer resolution, it is longer. Once a search has taken more than
// max_batches batches, the step doubles with each further walk (of at most 256 batches), so that every ray terminates.
// Once the ray is away from the interface, steps are a resolution again. After a walk, the kernel searches the rest of
// the ray, at the object's resolution.
#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

/// Finishes a search that the kernel left unfinished. Returns whether there is a crossing. Adds to the counters.
bool finish_search(const kernel::Visit&, kernel::RayCrossing&, TraceCounters&);

}  // namespace phasetree::trace
