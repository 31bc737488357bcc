#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/model/crossing.hpp"

/// Rays that creep along an interface.
///
/// Where a ray runs within a face, an edge or a seam its distance from the interface is zero to rounding for long, and
/// samples prove nothing but what is within a resolution of them. The kernel gives up for now after some batches. What
/// lies ahead is then enclosed: interval arithmetic with derivatives along the ray (Enclosure, of one variable) bounds
/// the component φ of the ray's phase over a whole stretch. Where φ < resolution/16 throughout no other phase is deeper
/// than rounding, which is no change of label (March::is_crossing), and the ray goes on behind the stretch. Along a
/// plane one such stretch is all there is of it; what bends takes stretches of about √(resolution · radius).
///
/// Where that proves nothing (outlines, patterns and images, whose derivatives are not known) the ray walks by steps of
/// a resolution, eight in a batch, while the interface is near; and where the label flickers by rounding the kernel
/// goes on, at three resolutions a batch. So the work is bounded by the length of the creep. The longest ray through an
/// object has half a million resolutions, as they are chosen; after so many batches (most_batches) steps double every
/// 256 batches until the ray is away from the interface, so that no ray takes forever at any resolution. What it
/// meets there is searched for at the resolution again.
namespace phasetree::trace {

using kernel::RayCrossing, kernel::Visit;

/// Ends a search that the kernel has left unfinished; whether there is a crossing.
bool finish_search(const Visit&, RayCrossing&, TraceCounters&);

}  // namespace phasetree::trace
