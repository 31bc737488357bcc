#pragma once

#include "phasetree/math/bounds.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::building {

using rewriting::WorkingProgram;

/// How long a box is divided although that saves nothing yet, because smaller boxes may save much. Boxes that are large
/// relative to the object are always divided, since an object's features are smaller than that; others only a few times
/// in a row without a gain. Lengths are shares of the object's diagonal.
struct SubdivisionPolicy {
    float large = 0.06f;            ///< larger boxes are always divided
    int most_futile_divisions = 2;  ///< how many divisions in a row may be without a gain
    /// A box is also divided if the spread of its linear bound is more than this times the length of the bound's
    /// normal, that is, if the gradient varies by a larger share of itself; unless the box is smaller than `fine`.
    float uneven = Bounds::infinity;
    float fine = 0.004f;  ///< see `uneven`

    SubdivisionPolicy() = default;
    /// The policy for a program that takes this much work. Programs of little but long primitives (Voronoi cells) are
    /// tried less, because a trial costs as much as many rays. A neural field costs rays so much, and is known so much
    /// better in small boxes, that boxes are divided until its gradient hardly varies (`uneven`); that is known of each
    /// box, so beyond it fewer divisions are tried than usually.
    SubdivisionPolicy(const WorkingProgram&, float work);
};

}  // namespace phasetree::building
