#pragma once

#include <algorithm>

#include "rewriting/specialise.hpp"

namespace phasetree::rewriting {

using program::is_far_bound, program::is_fold;

/// What every part of an object's program has in common with the whole, and what a caller knows of all of them.
struct ProgramContext {
    std::span<const float> constants;  ///< of the whole program; its parts refer to the same
    PhaseSet opaque;                   ///< phases that no ray is ever in
    float rounding;                    ///< bounds the error of any value
    /// What no part of the program has if the whole has none.
    bool has_folds, has_local_primitives, has_far_bounds;

    ProgramContext(const WorkingProgram& whole, std::span<const float> numbers, PhaseSet opaque_phases, float error)
        : constants(numbers),
          opaque(opaque_phases),
          rounding(error),
          has_folds(has(whole, is_fold)),
          has_local_primitives(has_local_primitive(whole)),
          has_far_bounds(has(whole, is_far_bound)) {}

  private:
    static bool has(const WorkingProgram& program, bool (*of_kind)(Op)) {
        return std::ranges::any_of(program.code, [&](const Instruction& in) { return of_kind(in.op); });
    }
};

}  // namespace phasetree::rewriting
