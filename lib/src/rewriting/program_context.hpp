#pragma once

#include "phasetree/model/phase.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// Data that all programs derived from an object's program share with it. Some of these are facts about the whole
/// object supplied by the caller. The others save work: a property that the whole program lacks need not be tested in a
/// derived one.
struct ProgramContext {
    std::span<const float> constants;  ///< of the whole program; the instructions of derived programs refer to them
    PhaseSet opaque;                   ///< phases that no ray is ever in
    /// An upper bound on the rounding error of any value, as a distance: half a resolution (cells/build.cpp).
    float value_error;
    bool has_folds;             ///< whether an instruction folds space
    bool has_local_primitives;  ///< whether an instruction is a LocalPrimitive
    bool has_far_bounds;        ///< whether an instruction enlarges distances far from the surface

    ProgramContext(const WorkingProgram& whole, std::span<const float> constants, PhaseSet opaque, float value_error);
};

}  // namespace phasetree::rewriting
