#pragma once

#include "phasetree/math/bounds.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::building {

using rewriting::WorkingProgram;

/// How long a box is divided although that saves nothing yet, because smaller boxes may save much. Boxes that are large
/// relative to the object are always divided, since an object's features are smaller than that; others only a few times
/// in a row without a gain. Lengths are shares of the object's diagonal.
struct SubdivisionPolicy {
    float large = 0.06f;              ///< larger boxes are always divided
    int futile_divisions = 2;         ///< how many divisions in a row may be without a gain
    float uneven = Bounds::infinity;  ///< a box is also divided where the gradient varies by a larger share of itself,
    float fine = 0.004f;              ///< unless it is smaller than this

    SubdivisionPolicy() = default;
    /// The policy for a program that takes this much work. Programs of little but long primitives (Voronoi cells) are
    /// tried less, because a trial costs as much as many rays. But a neural field costs rays so much, and is known so
    /// much better in small boxes, that boxes are divided until its gradient hardly varies.
    SubdivisionPolicy(const WorkingProgram&, float work);
};

}  // namespace phasetree::building
