#pragma once

#include "rewriting/specialise.hpp"
#include "building/progress.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// What every step of the division needs.
struct BuildContext {
    const CellOptions& options;
    BuildProgress& progress;
    std::span<const float> constants;
    float reach;     ///< how far beyond its share a cell must be right
    float rounding;  ///< error of a value
    float size;      ///< of the object
    /// What no part's program has if that of the whole has none.
    bool has_folds, has_local_primitives, has_far_bounds;

    BuildContext(const CellOptions& all, BuildProgress& told, const WorkingProgram& program, std::span<const float> numbers,
             float beyond, float error, float diagonal)
        : options(all),
          progress(told),
          constants(numbers),
          reach(beyond),
          rounding(error),
          size(diagonal),
          has_folds(std::ranges::any_of(program.code, [](const Instruction& in) { return is_fold(in.op); })),
          has_local_primitives(has_local_primitive(program)),
          has_far_bounds(std::ranges::any_of(program.code, [](const Instruction& in) { return is_far_bound(in.op); })) {
    }
};

}  // namespace phasetree
