#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/model/phase.hpp"

namespace phasetree {

/// A change of phase along a ray, as a bracket no longer than the resolution, whose ends are certified to have the two
/// labels. (Where solids abut, rounding can leave a sliver of a third phase between them: a bracket may pass over one,
/// and is then up to 2.7 resolutions long.) A reflected ray starts at p_in and stays in `from`, a refracted one at
/// p_out in `to`; no offset along a normal, no second evaluation, no self-hit.
struct Crossing {
    float t_in = 0;  ///< distances from the ray's origin
    float t_out = 0;
    glm::vec3 p_in{0};  ///< the very points that were evaluated
    glm::vec3 p_out{0};
    Phase from;
    Phase to;
};

/// The normal of a crossing, and what a ray that leaves it may tell the cell that found it (LeavingHint).
///
/// It is of unit length and leads from `from` into `to`, so that it points along the ray, never against it: into a
/// solid where the ray enters, out of it where it leaves. (Embree's Ng, which the plugin gives, faces the ray: it is
/// minus this.) It is the gradient of `from` at p_in, unless that is zero to rounding or contradicts the bracket: then
/// a gradient a resolution or two beside, where it is certain. By an edge it is that of one of the faces, or of the
/// distance to the edge, which lies between.
struct CrossingNormal {
    glm::vec3 unit{0};
    /// How the distance from `from` grows at p_in, as a vector: along `unit`, and 1 long at most. Zero where the normal
    /// was not told by that.
    glm::vec3 gradient{0};
};

/// What tracing cost, for --stats.
struct TraceCounters {
    std::uint64_t visits = 0;    ///< searches: one for each cell that a ray meets
    std::uint64_t batches = 0;   ///< evaluations of eight points
    std::uint64_t phantoms = 0;  ///< steps by the resolution that met no change of label
};

}  // namespace phasetree
