#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/model/phase.hpp"

namespace phasetree {

/// A change of phase along a ray: a bracket no longer than the resolution, whose ends are proven to be in the two
/// phases. Either the labels were evaluated there, or the values and the curvature bounds of samples on both sides
/// prove them. (Where solids abut, rounding can leave a sliver of a third phase between them. A bracket may pass over
/// one, and is then up to 2.75 resolutions long.) A reflected ray starts at p_in and stays in `from`, a refracted one
/// starts at p_out in `to`, so neither needs an offset along a normal, and neither meets the same crossing again.
///
/// A ray that carries a phase which is nowhere near its start crosses at once. This crossing has no length: p_in and
/// p_out are the place where the search begins, which is in `to`, and `from` is only what the ray has said.
struct Crossing {
    float t_in = 0;      ///< distance from the ray's origin to p_in
    float t_out = 0;     ///< distance from the ray's origin to p_out
    glm::vec3 p_in{0};   ///< the bracket's end in `from`
    glm::vec3 p_out{0};  ///< the bracket's end in `to`
    Phase from;          ///< the phase before the crossing
    Phase to;            ///< the phase behind it
};

/// The normal of a crossing, and the gradient from which a ray that leaves the crossing gets its LeavingHint.
///
/// The normal leads from `from` into `to`, so it points along the ray: into a solid where the ray enters, out of it
/// where it leaves. (Embree's Ng, which the plugin gives, faces the ray and is the opposite.) It is the direction of
/// the gradient of the component of `from` at p_in. If that gradient is zero to rounding or contradicts the bracket,
/// one is taken a resolution or two away, where it is certain. Near an edge it is the normal of one of the faces, or
/// that of the distance to the edge, which lies between them.
struct CrossingNormal {
    glm::vec3 unit{0};  ///< of unit length
    /// The gradient of the component of `from` at p_in, along `unit` and at most 1 long; zero if the normal was not
    /// taken from it.
    glm::vec3 gradient{0};
};

/// Counts what tracing has cost, for statistics.
struct TraceCounters {
    std::uint64_t visits = 0;    ///< searches: one for each cell that a ray meets
    std::uint64_t batches = 0;   ///< evaluations of eight points
    std::uint64_t phantoms = 0;  ///< steps by the resolution that met no change of label
};

}  // namespace phasetree
