#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/model/phase.hpp"

namespace phasetree {

/// A change of phase along a ray: a bracket whose ends are proven to lie in the two phases. The proof is either an
/// evaluation of the label (the phase with the smallest distance) at each end, or samples on both sides together with
/// curvature bounds. A reflected ray starts at p_from and stays in `from`; a refracted ray starts at p_to in `to`.
/// Neither needs an offset along the normal, and neither finds the same crossing again.
///
/// The bracket is no longer than the resolution, with one exception: where solids abut, rounding can leave a sliver of
/// a third phase between them. A bracket may span such a sliver, and is then up to 2.75 resolutions long.
///
/// The caller may say which phase the ray is in (`carried` in first_crossing()). If that phase occurs nowhere near the
/// start of the search, a crossing is reported there. The search begins at the ray's own start if that is in the
/// searched box, otherwise where the ray enters the box: the object's bounds for InterfaceTracer, the cell's box for
/// InterfaceCells. This crossing has zero length: p_from and p_to are that point, which is in `to`, and `from` is the
/// carried phase. There is one exception: in a cell whose program is a single mesh, a ray that enters carrying a wrong
/// phase and meets no face keeps that phase.
struct Crossing {
    float t_from = 0;     ///< distance from the ray's origin to p_from
    float t_to = 0;       ///< distance from the ray's origin to p_to
    glm::vec3 p_from{0};  ///< the bracket's end in `from`
    glm::vec3 p_to{0};    ///< the bracket's end in `to`
    Phase from;           ///< the phase before the crossing
    Phase to;             ///< the phase after the crossing
};

/// The normal of a crossing.
///
/// The normal points from `from` into `to`, so it points along the ray: into a solid where the ray enters, out of it
/// where it leaves. (Embree's Ng, as returned by the plugin, faces the ray and is the opposite.) It is the direction of
/// the gradient, at p_from, of the component of `from`: the signed distance of that phase, negative inside it. That
/// gradient may be zero up to rounding errors, or contradict the bracket: a plane with this normal and distance would
/// not cross the ray between p_from and p_to. The gradient is then taken one or two resolutions away, where it is
/// certain. Near an edge, it is the normal of one of the faces, or the gradient of the distance to the edge, whose
/// direction is between theirs.
struct CrossingNormal {
    glm::vec3 unit{0};  ///< of unit length
    /// The gradient of the component of `from` at p_from. It points along `unit`, and its length is at most 1. A
    /// LeavingHint (model/ray.hpp) for a ray that starts at this crossing is made from it. Zero if the normal was not
    /// taken from this gradient.
    glm::vec3 gradient{0};
};

/// Counters of the cost of tracing, for statistics.
struct TraceCounters {
    std::uint64_t visits = 0;   ///< searches: one per cell that a ray meets
    std::uint64_t batches = 0;  ///< evaluations of eight points
    /// False alarms: steps of at most one resolution that might have crossed an interface, but in which the label does
    /// not change.
    std::uint64_t phantoms = 0;
};

}  // namespace phasetree
