#pragma once

#include "phasetree/math/bounds.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::building {

using rewriting::WorkingProgram;

/// How far to divide a box although that saves nothing yet, because smaller boxes may save a lot. Boxes that are large
/// relative to the object are always divided, because an object's features are smaller. Others are divided only a few
/// times in a row without a gain. Lengths are fractions of the object's diagonal.
struct SubdivisionPolicy {
    float large = 0.06f;            ///< larger boxes are always divided
    int most_futile_divisions = 2;  ///< maximum number of consecutive divisions without a gain
    /// A box larger than `fine` is also divided if its gradient varies a lot: if the spread of its linear bound exceeds
    /// this many times the length of the bound's normal.
    float uneven = Bounds::infinity;
    float fine = 0.004f;  ///< see `uneven`

    SubdivisionPolicy() = default;
    /// The policy for a program with this much work. Programs that consist mainly of long primitives (Voronoi cells)
    /// are tried less, because a trial costs as much as many rays. A neural field is expensive for rays and much better
    /// known in small boxes, so boxes are divided until its gradient hardly varies (`uneven`). Each box shows whether
    /// that is so, so fewer divisions than usual are tried beyond it.
    SubdivisionPolicy(const WorkingProgram&, float work);
};

}  // namespace phasetree::building
